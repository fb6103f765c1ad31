// The choice of fluents that a general picture shows, and their layout.
#pragma once

#include "render/canvas.hpp"
#include "render/snapshot.hpp"
#include "render/widgets.hpp"

#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rddl::render {

// The state-fluents in declaration order.
std::vector<const rddl_fluent*> state_fluents(const rddl_problem& problem);

// The least and greatest value that numbers of a fluent take in the steps, and 0 and 1 for bools;
// its bounds if it has two. The range without a finite number is 0 to 1.
struct Range {
    double low = 0, high = 1;

    double part(double value) const {
        if (high > low) return (value - low) / (high - low);
        return std::isfinite(value) ? 0.5 : NAN;
    }
};
Range range_of(const Snapshot& snapshot, const rddl_fluent& fluent);

// The colour of a value within its range; objects have colours of their own.
Color value_color(const Values& values, double value, const Range& range);

// Draws the key of the value's colours at the right of the box, if there is room. Names of objects
// that do not fit in the box stand in `other` if they fit there.
void draw_key(Canvas& canvas, const Box& box, const Values& values, const Range& range,
              const Box& other = {});

// "r1, c2" of "at(r1, c2)": the objects of a grounding.
std::string objects_of(const Snapshot& snapshot, const rddl_fluent& fluent, std::int64_t grounding);

// Boxes of one size that fill the area, in rows, with a gap between them.
std::vector<Box> panel_boxes(const Box& area, std::size_t count, double wanted_shape, double gap);

}  // namespace rddl::render
