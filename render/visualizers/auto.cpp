// Chooses among the visualizers for any problem by the shape of the state.
#include "render/panels.hpp"
#include "render/visualizers/visualizers.hpp"

namespace rddl::render::automatic {

namespace {

const Visualizer& choice(const rddl_problem& problem) {
    constexpr std::size_t most_panels = 24;
    std::int64_t values = 0, in_grids = 0;
    const std::vector<const rddl_fluent*> fluents = state_fluents(problem);
    for (const rddl_fluent* const fluent : fluents) {
        values += fluent->count;
        if (fluent->rank >= 2 && fluent->count >= 9) in_grids += fluent->count;
    }
    if (in_grids * 2 > values) return heatmap::visualizer;
    return fluents.empty() || fluents.size() > most_panels ? text::visualizer : chart::visualizer;
}

void draw(Canvas& canvas, const Box& area, const Snapshot& snapshot) {
    choice(snapshot.problem()).draw(canvas, area, snapshot);
}

}  // namespace

const Visualizer visualizer{
    "auto", "chart, heatmap or text, whichever suits the shape of the state", {}, {}, draw};

}  // namespace rddl::render::automatic
