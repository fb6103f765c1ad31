// The policy that PPO imitates before it learns, for command lines and Python.
#pragma once

#include "learning/planned_policy.hpp"
#include "solvers/options/options.hpp"
#include "solvers/ppo/demonstrations.hpp"

#include <cstdint>
#include <functional>
#include <string>

namespace rddlc::workbench {

struct Imitation {
    std::string policy;  // a name, as policy_named takes it; "": nothing is imitated
    std::int64_t episodes = 20;
};

const solvers::OptionTable<Imitation>& imitation_option_table();

// Plays it; empty where nothing is imitated. The simulator must outlive the result. seed: the
// learner's. stops: whether to give up, which throws a Failure. quiet: without a progress bar.
solvers::Demonstrate demonstrate(const rddl_simulator& simulator, const Imitation& imitation,
                                 std::uint64_t seed, std::int64_t memory_limit,
                                 const PlannerSettings& planning,
                                 const std::function<bool()>& stops, bool quiet);

}  // namespace rddlc::workbench
