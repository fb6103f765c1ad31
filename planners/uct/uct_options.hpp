// Options of plan:uct.
#pragma once

#include "planners/planner/common_options.hpp"

namespace rddlc::planners {

enum class Backup { Max, Mean };
enum class Initial { Lookahead, Rollout };

struct UctOptions : CommonOptions {
    int lanes = 32;            // trials side by side
    int actions = 4096;        // at most
    double exploration = 0.5;  // in ranges of the returns
    double outcomes = 4;       // of an action that was taken n times, at most outcomes * sqrt(n)
    Backup backup = Backup::Max;
    Initial initial = Initial::Lookahead;
};

const solvers::OptionTable<UctOptions>& uct_option_table();

}  // namespace rddlc::planners
