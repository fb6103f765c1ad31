// All visualizers; table.cpp lists them. Each is a file of this folder, and a namespace: two
// may use the same names for what only they draw.
#pragma once

#include "render/visualizer.hpp"

namespace rddl::render {

// Visualizers for any problem.
namespace automatic {
extern const Visualizer visualizer;
}
namespace chart {
extern const Visualizer visualizer;
}
namespace heatmap {
extern const Visualizer visualizer;
}
namespace text {
extern const Visualizer visualizer;
}

// Visualizers for problems of some domains.
namespace acrobot {
extern const Visualizer visualizer;
}
namespace cart_pole {
extern const Visualizer visualizer;
}
namespace elevators {
extern const Visualizer visualizer, visualizer_of_counts;
}
namespace game_of_life {
extern const Visualizer visualizer;
}
namespace hvac {
extern const Visualizer visualizer, visualizer_of_air;
}
namespace intruders {
extern const Visualizer visualizer, visualizer_of_grid;
}
namespace mars_rover {
extern const Visualizer visualizer;
}
namespace mountain_car {
extern const Visualizer visualizer;
}
namespace navigation {
extern const Visualizer visualizer;
}
namespace network {
extern const Visualizer visualizer;
}
namespace pendulum {
extern const Visualizer visualizer;
}
namespace pong {
extern const Visualizer visualizer;
}
namespace power_gen {
extern const Visualizer visualizer;
}
namespace quadcopter {
extern const Visualizer visualizer;
}
namespace race_car {
extern const Visualizer visualizer;
}
namespace reacher {
extern const Visualizer visualizer;
}
namespace recommender {
extern const Visualizer visualizer;
}
namespace reservoir {
extern const Visualizer visualizer;
}
namespace robot_grid {
extern const Visualizer visualizer, visualizer_of_crossing;
}
namespace sliding_squares {
extern const Visualizer visualizer;
}
namespace sokoban {
extern const Visualizer visualizer;
}
namespace sudoku {
extern const Visualizer visualizer;
}
namespace tetris {
extern const Visualizer visualizer;
}
namespace tower_of_hanoi {
extern const Visualizer visualizer;
}
namespace traffic {
extern const Visualizer visualizer;
}
namespace traffic_cells {
extern const Visualizer visualizer;
}
namespace uav {
extern const Visualizer visualizer;
}
namespace wildfire {
extern const Visualizer visualizer;
}

}  // namespace rddl::render
