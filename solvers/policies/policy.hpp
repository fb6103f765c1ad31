// The one interface of all policies: random, no-op, a policy block, what PPO and CGP have learned,
// a recorded plan. Batch in, batch out.
#pragma once

#include "solvers/batches/stops.hpp"

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace rddlc::solvers {

// The question to a policy: a batch of n environments before its next step.
struct Decision {
    rddl_batch* batch;
    std::span<const std::uint8_t> running;   // n; 0: the episode is over, any action will do
    std::span<const std::int64_t> episodes;  // n; which episode each is, for random numbers
    std::span<const std::int64_t> steps;     // n; steps made in each episode
    std::byte* actions;                      // n records to write
    // n; the first precondition that each action violates, or -1. Who has asked for it anyway
    // writes it and says so.
    std::span<std::int32_t> violated;
    bool knows_violated = false;
    const Stops* stops = nullptr;  // where choosing ends early
    // Steps of an episode, as batches have it: 0: the instance's; RDDL_NO_HORIZON: none.
    std::int64_t horizon = 0;
};

// Acts in one batch, whose episodes have just begun, once for each step; remembers what it needs of
// them.
using Actor = std::function<void(Decision&)>;

// How much a policy tends to some actions, in the states of a batch after so many steps of their
// episodes: a row of logarithms for each environment, up to a constant of the row.
using ActionPriors =
    std::function<void(rddl_batch* batch, std::span<const std::int64_t> steps, float* rows)>;

// Estimates of what a policy still gets paid, in the states of a batch after so many steps of their
// episodes: a number for each environment, in the problem's rewards.
using StateValues =
    std::function<void(rddl_batch* batch, std::span<const std::int64_t> steps, double* values)>;

struct Policy {
    std::string name;
    std::uint64_t spaces;  // that it acts in (spaces_of); run_episodes refuses others
    // An actor for so many environments. Several may be at work in different threads.
    std::function<Actor(std::int64_t environments)> start;
    std::int64_t plans = 0;  // that it plays, one after the other; 0: it is not recorded
    // It decides for one environment after the other: a batch of them only takes memory.
    bool decides_one_by_one = false;
    // The priors of these records of actions, in so many environments; empty where the policy knows
    // nothing but its action. The policy must outlive them.
    std::function<ActionPriors(std::int64_t environments, std::span<const std::byte> actions)>
        priors = {};
    // Its estimates in so many environments; empty where it has none. The policy must outlive them.
    std::function<StateValues(std::int64_t environments)> values = {};
    double value_discount = 1;  // of the rewards that these estimates sum up
    // Its actors do what their arguments say alone, so that one may go on to other episodes.
    bool is_memoryless = false;
    bool is_constant = false;  // it takes the same action in all steps
};

// Throws a Failure where the policy is of other spaces than those of the simulator.
void require_spaces(const Policy& policy, const rddl_simulator& simulator);

// `simulator` must outlive these policies.
Policy random_policy(const rddl_simulator& simulator, std::uint64_t seed);
Policy noop_policy(const rddl_simulator& simulator);
// The simulator's policy block, which must be there.
Policy block_policy(const rddl_simulator& simulator);
// Recorded plans: the t-th of a plan's action records in step t of an episode, whatever the state;
// after the last of them the default action. Episode e plays plan e; after the last plan comes the
// first one again, so that one plan is played in all episodes.
Policy plan_policy(const rddl_simulator& simulator, std::string name,
                   std::vector<std::vector<std::byte>> plans);

}  // namespace rddlc::solvers
