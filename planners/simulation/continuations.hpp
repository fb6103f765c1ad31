// Values of actions and states by simulation: a policy plays on from them, many times in one batch.
#pragma once

#include "planners/planner/planner.hpp"
#include "planners/simulation/base_policy.hpp"
#include "planners/simulation/budget.hpp"
#include "planners/simulation/futures.hpp"

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rddlc::planners {

struct Start {
    const std::byte* state;   // NULL: that of the decision
    std::int64_t step;        // of the episode, of that state
    const std::byte* action;  // the first one; NULL: also the policy's
    std::int64_t depth;       // steps, at least 1
    std::uint64_t stream;
};

class Continuations {
  public:
    // `keeps_first_steps` is for callers that ask for first actions, rewards and states.
    Continuations(const rddl_simulator& simulator, std::int64_t lanes, std::int64_t horizon,
                  bool keeps_first_steps);

    std::size_t lanes() const { return static_cast<std::size_t>(futures_.count()); }
    // Plays at most `lanes` starts. False if time was up: then the values are those of fewer steps.
    bool run(const DecisionPoint& point, std::span<const Start> starts, BasePolicy& policy,
             BudgetMeter& meter);

    // The results of start k: the discounted sum of rewards, the first reward, and the state after
    // it.
    double value(std::size_t k) const { return futures_.value(k); }
    // Whether its steps ended before its episode did, and the reward of the last step.
    bool is_cut(std::size_t k) const { return futures_.is_cut(k); }
    double last_reward(std::size_t k) const { return futures_.last_reward(k); }
    double first_reward(std::size_t k) const { return first_rewards_[k]; }
    const std::byte* first_state(std::size_t k) const {
        return first_states_.data() + k * state_size_;
    }
    const std::byte* first_action(std::size_t k) const {
        return first_actions_.data() + k * action_size_;
    }
    // Steps that were made of all starts: 0 where time was up before the first one.
    std::int64_t depth() const { return depth_; }

  private:
    void begin(const DecisionPoint& point, std::span<const Start> starts);
    bool keeps_first_steps() const { return !first_rewards_.empty(); }

    const rddl_simulator& simulator_;
    std::size_t state_size_, action_size_;
    Futures futures_;
    std::vector<std::byte> states_, first_actions_, first_states_;
    Aligned<std::byte> actions_;
    std::vector<std::int64_t> steps_;
    std::vector<std::uint64_t> streams_;
    std::vector<std::uint8_t> wanted_;  // first actions, of the policy
    bool any_wanted_ = false;
    std::vector<double> first_rewards_;
    std::int64_t depth_ = 0;
};

}  // namespace rddlc::planners
