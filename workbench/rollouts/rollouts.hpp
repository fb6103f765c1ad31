// Episodes as the commands run them: with a progress bar, traces and Ctrl-C.
#pragma once

#include "learning/planned_policy.hpp"
#include "rollouts/violations.hpp"
#include "solvers/evaluation/episodes.hpp"
#include "terminal/interrupt.hpp"

#include <rddl/simulator.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace rddlc::workbench {

using solvers::Episode;
using solvers::EpisodeFault;
using solvers::EpisodeViolation;
using solvers::Rollouts;

// Rddl: the policy block of the problem, which must have one. Learned: that of `learned`.
// Planner: that of `planner`.
enum class Policy { Random, Noop, Rddl, Learned, Planner };
std::string_view name_of(Policy policy);  // "random", ...

struct RolloutOptions : solvers::EpisodeOptions {
    Policy policy = Policy::Random;
    std::filesystem::path learned = {};  // a policy file, or the folder of a run
    std::string planner = {};            // "plan:cem,seconds=0.1"
    PlannerSettings planning = {};
};

// "episode 3, step 7: domain.rddl:12:9: ..."
std::string fault_line(const EpisodeFault& fault);

// A planner's is its text.
std::string policy_name(const RolloutOptions& options);

// Receives the trace lines of consecutive episodes, in order; called by one thread at a time. With
// one thread and batches of one it gets each line as soon as the step is made.
using TraceSink = std::function<void(const std::string& lines)>;

// Stops early, with what is finished, once is_interrupted(). `trace` may be empty.
Rollouts run_episodes(const rddl_simulator& simulator, const RolloutOptions& options,
                      const TraceSink& trace, bool progress);
// The same with any policy, and another question for whether to stop; an empty one never does.
Rollouts run_episodes(const rddl_simulator& simulator, const solvers::Policy& policy,
                      const solvers::EpisodeOptions& options, const TraceSink& trace, bool progress,
                      const solvers::Stops& stops = is_interrupted);

}  // namespace rddlc::workbench
