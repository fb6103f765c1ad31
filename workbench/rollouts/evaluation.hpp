// The returns of a policy in many episodes.
#pragma once

#include "learning/planned_policy.hpp"
#include "solvers/evaluation/episodes.hpp"
#include "solvers/evaluation/summary.hpp"

#include <rddl/simulator.h>

#include <cstdint>
#include <optional>
#include <string>

namespace rddlc::workbench {

struct Evaluation {
    std::string policy;
    solvers::Summary summary;
    double seconds = 0;
    std::int64_t steps = 0;
    std::optional<solvers::EpisodeFault> first_fault;
};

// Runs episodes of the policy of this name (policy_named). A learned one acts at random if `random`
// says so, as it does while it learns. Shows a progress bar and a note on plans that are played
// several times, unless `quiet`.
Evaluation evaluate(const rddl_simulator& simulator, const std::string& name,
                    const solvers::EpisodeOptions& options, bool random, bool quiet,
                    const PlannerSettings& planning = {});

// The mean return of the last episodes while PPO learned, with random actions; nothing if the
// policy is not a run that reports it.
std::optional<double> learned_return(const std::string& policy);

}  // namespace rddlc::workbench
