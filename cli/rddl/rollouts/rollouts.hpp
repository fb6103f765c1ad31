// Episodes as the commands run them: with a progress bar, traces and Ctrl-C.
#pragma once

#include "rollouts/violations.hpp"
#include "solvers/evaluation/episodes.hpp"
#include "support/memory.hpp"

#include <rddl/simulator.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace rddlc::cli {

using solvers::Episode;
using solvers::EpisodeFault;
using solvers::EpisodeViolation;
using solvers::Rollouts;

// Rddl: the policy block of the problem, which must have one. Learned: that of `learned`.
enum class Policy { Random, Noop, Rddl, Learned };
std::string_view name_of(Policy policy);  // "random", ...

struct RolloutOptions {
    Policy policy = Policy::Random;
    std::filesystem::path learned = {};  // a policy file, or the folder of a run
    Preconditions preconditions = Preconditions::Ignore;
    std::int64_t episodes = 1;
    std::uint64_t seed = 0;
    std::optional<std::int64_t> horizon = {};  // 0: none; absent: the instance's
    int threads = 0;                           // 0: one per core
    std::int64_t batch = 0;                    // environments stepped together; 0: chosen here
    std::int64_t memory_limit = default_memory_limit;  // bytes of all environments
};

// Receives the trace lines of consecutive episodes, in order; called by one thread at a time.
using TraceSink = std::function<void(const std::string& lines)>;

// Stops early, with what is finished, once is_interrupted(). `trace` may be empty.
Rollouts run_episodes(const rddl_simulator& simulator, const RolloutOptions& options,
                      const TraceSink& trace, bool progress);
// The same with another policy than that of the options.
Rollouts run_episodes(const rddl_simulator& simulator, const solvers::Policy& policy,
                      const RolloutOptions& options, const TraceSink& trace, bool progress);

}  // namespace rddlc::cli
