// The table of visualizers. Among those for a domain the first one whose fluents the problem has is
// used: several problems share a domain's name.
#include "render/visualizers/visualizers.hpp"

#include <algorithm>

namespace rddl::render {

std::span<const Visualizer* const> visualizers() {
    static const Visualizer* const all[] = {&automatic::visualizer,
                                            &chart::visualizer,
                                            &heatmap::visualizer,
                                            &text::visualizer,
                                            &acrobot::visualizer,
                                            &cart_pole::visualizer,
                                            &elevators::visualizer,
                                            &elevators::visualizer_of_counts,
                                            &game_of_life::visualizer,
                                            &hvac::visualizer,
                                            &hvac::visualizer_of_air,
                                            &intruders::visualizer,
                                            &intruders::visualizer_of_grid,
                                            &mars_rover::visualizer,
                                            &mountain_car::visualizer,
                                            &navigation::visualizer,
                                            &network::visualizer,
                                            &pendulum::visualizer,
                                            &pong::visualizer,
                                            &power_gen::visualizer,
                                            &quadcopter::visualizer,
                                            &race_car::visualizer,
                                            &reacher::visualizer,
                                            &recommender::visualizer,
                                            &reservoir::visualizer,
                                            &robot_grid::visualizer,
                                            &robot_grid::visualizer_of_crossing,
                                            &sliding_squares::visualizer,
                                            &sokoban::visualizer,
                                            &sudoku::visualizer,
                                            &tetris::visualizer,
                                            &tower_of_hanoi::visualizer,
                                            &traffic::visualizer,
                                            &traffic_cells::visualizer,
                                            &uav::visualizer,
                                            &wildfire::visualizer};
    return all;
}

const Visualizer* find_visualizer(std::string_view name) {
    const auto all = visualizers();
    const auto found = std::find_if(all.begin(), all.end(), [&](const Visualizer* visualizer) {
        return visualizer->name == name;
    });
    return found == all.end() ? nullptr : *found;
}

std::string_view missing_fluent(const Visualizer& visualizer, const World& world) {
    for (const std::string_view name : visualizer.fluents)
        if (!world.find(name)) return name;
    return {};
}

const Visualizer& visualizer_for(const World& world) {
    const std::string_view domain = world.problem().domain;
    for (const Visualizer* const visualizer : visualizers()) {
        const auto& domains = visualizer->domains;
        if (std::find(domains.begin(), domains.end(), domain) != domains.end() &&
            missing_fluent(*visualizer, world).empty())
            return *visualizer;
    }
    return automatic::visualizer;
}

}  // namespace rddl::render
