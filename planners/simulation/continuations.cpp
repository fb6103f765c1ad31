#include "planners/simulation/continuations.hpp"

#include "solvers/batches/batch.hpp"

#include <algorithm>
#include <cstring>

namespace rddlc::planners {

Continuations::Continuations(const rddl_simulator& simulator, std::int64_t lanes,
                             std::int64_t horizon, bool keeps_first_steps)
    : simulator_(simulator),
      state_size_(static_cast<std::size_t>(simulator.problem->state_size)),
      action_size_(static_cast<std::size_t>(simulator.problem->action_size)),
      futures_(simulator, lanes, horizon),
      states_(futures_.running().size() * state_size_),
      first_actions_(keeps_first_steps ? futures_.running().size() * action_size_ : 0),
      first_states_(keeps_first_steps ? states_.size() : 0),
      actions_(futures_.running().size() * action_size_),
      steps_(futures_.running().size()),
      streams_(steps_.size()),
      wanted_(steps_.size()),
      first_rewards_(keeps_first_steps ? steps_.size() : 0) {}

namespace {

// Records are short: a call for each would take longer than the copy.
void copy_record(const std::byte* from, std::size_t size, std::byte* to) {
    std::size_t k = 0;
    for (; k + sizeof(std::uint64_t) <= size; k += sizeof(std::uint64_t))
        std::memcpy(to + k, from + k, sizeof(std::uint64_t));
    for (; k < size; ++k) to[k] = from[k];
}

}  // namespace

// Lanes without a start are as the decision, and run no further.
void Continuations::begin(const DecisionPoint& point, std::span<const Start> starts) {
    const std::size_t count = starts.size(), size = action_size_;
    const auto* const none = static_cast<const std::byte*>(simulator_.problem->default_action);
    std::byte* const actions = actions_.data();
    bool is_elsewhere = false;
    any_wanted_ = false;
    for (std::size_t k = 0; k < count; ++k) {
        const Start& start = starts[k];
        streams_[k] = start.stream;
        steps_[k] = start.step;
        wanted_[k] = !start.action;
        any_wanted_ |= !start.action;
        is_elsewhere |= start.state != nullptr;
    }
    for (std::size_t k = 0; k < count; ++k)
        copy_record(starts[k].action ? starts[k].action : none, size, actions + k * size);
    for (std::size_t k = count; k < lanes(); ++k) {
        streams_[k] = 0;
        steps_[k] = point.step;
        wanted_[k] = 0;
        copy_record(none, size, actions + k * size);
    }
    futures_.begin(point.origin, streams_);
    if (is_elsewhere) {
        solvers::require_done(simulator_, simulator_.get_state(futures_.batch(), 0,
                                                               futures_.count(), states_.data()));
        for (std::size_t k = 0; k < count; ++k)
            if (starts[k].state)
                std::copy_n(starts[k].state, state_size_, states_.data() + k * state_size_);
        futures_.place(states_.data(), steps_);
    }
    for (std::size_t k = 0; k < lanes(); ++k)
        futures_.set_limit(k, k < count ? starts[k].depth : 1);
}

bool Continuations::run(const DecisionPoint& point, std::span<const Start> starts,
                        BasePolicy& policy, BudgetMeter& meter) {
    begin(point, starts);
    policy.begin(point.episode, steps_, point.horizon, streams_);
    for (depth_ = 0; futures_.any_running(); ++depth_) {
        if (depth_ == 0 && (any_wanted_ || !policy.is_constant()))
            policy.act(futures_, wanted_, actions_.data(), point.stops);
        else if (depth_ == 1 || !policy.is_constant())
            policy.act(futures_, actions_.data(), point.stops);
        if (depth_ == 0 && keeps_first_steps()) std::ranges::copy(actions_, first_actions_.begin());
        if (depth_ % 4 == 0 && meter.is_late()) return false;
        futures_.step(actions_.data());
        const auto idle = static_cast<std::int64_t>(depth_ == 0 ? lanes() - starts.size() : 0);
        meter.add_steps(futures_.stepped() - idle);
        if (depth_ > 0 || !keeps_first_steps()) continue;
        solvers::require_done(
            simulator_,
            simulator_.get_state(futures_.batch(), 0, futures_.count(), first_states_.data()));
        for (std::size_t k = 0; k < lanes(); ++k) first_rewards_[k] = futures_.reward(k);
    }
    return true;
}

}  // namespace rddlc::planners
