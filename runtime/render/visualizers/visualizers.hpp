// All visualizers; table.cpp lists them. Each is a file of this folder, and a namespace: two
// may use the same names for what only they draw.
#pragma once

#include "render/visualizer.hpp"

namespace rddl::render {

// For any problem.
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

}  // namespace rddl::render
