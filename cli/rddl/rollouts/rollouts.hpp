// Whole episodes under a simple policy, in parallel.
//
// Episode number e is environment e of the seed, so its course depends on seed and number only:
// not on how many others run, in which batch, or on which thread.
#pragma once

#include "rollouts/violations.hpp"
#include "support/memory.hpp"

#include <rddl/simulator.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::cli {

// Rddl: the policy block of the problem, which must have one.
enum class Policy { Random, Noop, Rddl };
std::string_view name_of(Policy policy);  // "random", ...

struct RolloutOptions {
    Policy policy = Policy::Random;
    Preconditions preconditions = Preconditions::Ignore;
    std::int64_t episodes = 1;
    std::uint64_t seed = 0;
    std::optional<std::int64_t> horizon = {};  // 0: none; absent: the instance's
    int threads = 0;                           // 0: one per core
    std::int64_t batch = 0;                    // environments stepped together; 0: chosen here
    std::int64_t memory_limit = default_memory_limit;  // bytes of all environments
};

struct Episode {
    bool finished = false;  // false only after an interrupt
    double undiscounted_return = 0;
    double discounted_return = 0;
    std::int64_t length = 0;  // steps
    std::uint8_t causes = RDDL_RUNNING;
    std::int64_t illegal_actions = 0;  // those that violate a precondition; 0 if nobody looks
    bool refused = false;              // ended by such an action, which was not taken
};

struct EpisodeFault {
    std::int64_t episode = 0;
    std::int64_t step = 0;
    std::string message;  // "file:line:column: ..."
};

struct EpisodeViolation {
    std::int64_t episode = 0;
    std::int64_t step = 0;  // the one that would be, or was, made
    Violation violation;
};

struct Rollouts {
    std::vector<Episode> episodes;  // by number
    // Each of the first episode that has one.
    std::optional<EpisodeFault> first_fault;
    std::optional<EpisodeViolation> first_illegal_action, first_broken_invariant;
    std::int64_t steps = 0;
    double seconds = 0;
    int threads = 0;          // that worked
    int missing_threads = 0;  // that the system did not give
};

// Receives the trace lines of consecutive episodes, in order; called by one thread at a time.
using TraceSink = std::function<void(const std::string& lines)>;

// Stops early, with what is finished, once is_interrupted(). `trace` may be empty.
Rollouts run_episodes(const rddl_simulator& simulator, const RolloutOptions& options,
                      const TraceSink& trace, bool progress);

}  // namespace rddlc::cli
