// Whole episodes under a policy, in parallel.
//
// Episode number e is environment e of the seed, so its course depends on seed and number only:
// not on how many others run, in which batch, or on which thread.
#pragma once

#include "solvers/evaluation/preconditions.hpp"
#include "solvers/policies/policy.hpp"
#include "support/memory.hpp"

#include <rddl/simulator.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rddlc::solvers {

// Learners end an episode of a problem without a horizon after 1,000 steps. Nothing: the problem
// has a horizon, which holds.
inline std::optional<std::int64_t> horizon_of_learners(const rddl_problem& problem) {
    return problem.horizon == 0 ? std::optional<std::int64_t>(1000) : std::nullopt;
}

struct EpisodeOptions {
    Preconditions preconditions = Preconditions::Ignore;
    std::int64_t episodes = 1;
    std::uint64_t seed = 0;
    std::optional<std::int64_t> horizon = {};  // 0: no horizon; absent: the instance's
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
    std::int64_t illegal_actions = 0;   // those that violate a precondition; 0 if not checked
    std::int64_t not_finite_step = -1;  // the first whose reward is inf or nan; -1: all are finite
    bool refused = false;               // ended by such an action, which was not taken
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

// Writes down what happens in the episodes of one batch, which run side by side.
struct Recorder {
    virtual ~Recorder() = default;
    virtual void before_step(const rddl_batch& batch) = 0;
    virtual void after_step(const rddl_batch& batch) = 0;
    // Called after a step, for each environment that was running; `i` is its place in the batch.
    virtual void add(std::size_t i, std::int64_t episode, std::int64_t step,
                     const std::byte* action, double reward, std::uint8_t causes) = 0;
    // The batch is over. Called for one batch after the other, in the order of their episodes.
    virtual void finish() = 0;
};

// Callbacks for observers; any of them may be empty. All threads call them.
struct Watch {
    std::function<bool()> stops;  // whether to end early, with what is finished
    // Reports that so many of all steps are done. The total is the horizon times the episodes, or
    // the number of episodes if their length is unknown (steps_at_most).
    std::function<void(std::int64_t)> advance;
    std::function<std::unique_ptr<Recorder>(std::int64_t environments)> record;
};

// The maximum number of steps of an episode; 0: unknown, or too many to count.
std::int64_t steps_at_most(const rddl_simulator& simulator, const EpisodeOptions& options);

// Throws what a policy or a recorder throws.
Rollouts run_episodes(const rddl_simulator& simulator, const Policy& policy,
                      const EpisodeOptions& options, const Watch& watch);

}  // namespace rddlc::solvers
