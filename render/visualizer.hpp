// How a state is drawn. A visualizer reads fluents by their names, and nothing else of a problem.
#pragma once

#include "render/canvas.hpp"
#include "render/snapshot.hpp"

#include <functional>
#include <initializer_list>
#include <span>
#include <string_view>
#include <vector>

namespace rddl::render {

using Draw = std::function<void(Canvas&, const Box&, const Snapshot&)>;

struct Visualizer {
    std::string_view name;
    std::string_view summary;               // what is to be seen, in a sentence
    std::vector<std::string_view> domains;  // that it is for; empty: any
    std::vector<std::string_view> fluents;  // without one of these it cannot draw
    Draw draw;
};

// All that there are: those for any problem first.
std::span<const Visualizer* const> visualizers();
// NULL: no visualizer has the name.
const Visualizer* find_visualizer(std::string_view name);

// The first fluent that the visualizer needs and the problem has not; empty: it has all.
std::string_view missing_fluent(const Visualizer& visualizer, const World& world);
// The one that is made for the problem's domain, or one that suits the shape of its state.
const Visualizer& visualizer_for(const World& world);

// A whole picture: title, what the visualizer draws, and a line with step, reward and action.
void draw_picture(Canvas& canvas, const Visualizer& visualizer, const Snapshot& snapshot);

}  // namespace rddl::render
