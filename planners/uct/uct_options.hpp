// Options of plan:uct.
#pragma once

#include "planners/planner/common_options.hpp"

#include <optional>

namespace rddlc::planners {

enum class Backup { Max, Mean };
enum class Initial { Determinised, Lookahead, Rollout, Value };

struct UctOptions : CommonOptions {
    int lanes = 32;      // trials side by side
    int actions = 4096;  // at most
    // In ranges of the returns; nothing: 0.5, or 1.25 by the values of a policy.
    std::optional<double> exploration;
    double outcomes = 4;  // of an action that was taken n times, at most outcomes * sqrt(n)
    // A node with n trials has at most width * n^widening actions, where they cannot be listed.
    double width = 1, widening = 0.5;
    Backup backup = Backup::Max;
    int lookahead = 256;  // states that a search in the determinised problem may meet
    bool plans = true;    // see TreeAndPlans
    // Nothing: Value with a policy that has values, Lookahead with another one, else Determinised.
    std::optional<Initial> initial;
    const char* option_for_values() const {
        return initial == Initial::Value ? "initial=value" : nullptr;
    }
};

const solvers::OptionTable<UctOptions>& uct_option_table();

}  // namespace rddlc::planners
