// Options of plan:rollout.
#pragma once

#include "planners/planner/common_options.hpp"

namespace rddlc::planners {

struct RolloutOptions : CommonOptions {
    int lanes = 256;        // roll-outs side by side
    int actions = 256;      // that are compared, at most
    double confidence = 1;  // standard errors by which one has to be better
};

const solvers::OptionTable<RolloutOptions>& rollout_option_table();

}  // namespace rddlc::planners
