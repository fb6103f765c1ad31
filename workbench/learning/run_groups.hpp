// Groups the runs that make one learning curve.
#pragma once

#include "learning/learning_curves.hpp"

#include <string>
#include <vector>

namespace rddlc::workbench {

// Runs that make one curve.
struct RunGroup {
    std::string name;
    std::string what;  // solver and problem: returns of different problems have no mean
    std::vector<RunProgress> runs;
};

// A folder of runs is a group; so are runs whose names differ in their seeds. With `each_alone`,
// each run is one.
std::vector<RunGroup> run_groups(const std::vector<std::string>& paths, bool each_alone);

// "steps" or "generations"; empty where solvers differ: a step of one is a generation of another,
// so side by side, they have only time in common.
std::string steps_title(const std::vector<RunGroup>& groups);

}  // namespace rddlc::workbench
