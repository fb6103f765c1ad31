// How quickly states are shown, and which of them.
#pragma once

#include "pictures/picture_options.hpp"

#include <render/snapshot.hpp>

#include <cstdint>

namespace rddlc::workbench {

struct Pace {
    double frames_per_second = 10;
    std::int64_t stride = 1;  // every so manyth state, and the last one

    static constexpr std::int64_t last_alone = 0;

    bool shows(std::int64_t state) const { return stride != last_alone && state % stride == 0; }
};

// The pace that the options ask for, in an episode with that horizon; 0: no horizon. Throws a
// Failure if --real-time-factor asks for the length of a step and the problem does not give it, or
// if options contradict.
Pace choose_pace(const PictureOptions& options, const rddl::render::World& world,
                 std::int64_t horizon);

}  // namespace rddlc::workbench
