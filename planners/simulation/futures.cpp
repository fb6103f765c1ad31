#include "planners/simulation/futures.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace rddlc::planners {

using solvers::require_done;

solvers::BatchHandle batch_of_lanes(const rddl_simulator& simulator, std::int64_t count,
                                    std::int64_t horizon) {
    rddl_batch_options options{};
    options.environment_count = count;
    options.thread_count = 1;  // episodes are planned for side by side
    options.horizon = horizon;
    return solvers::create_batch(simulator, options);
}

Futures::Futures(const rddl_simulator& simulator, std::int64_t count, std::int64_t horizon)
    : simulator_(simulator),
      batch_(batch_of_lanes(simulator, count, horizon)),
      sources_(static_cast<std::size_t>(count)),
      limits_(sources_.size()),
      rewards_(sources_.size()),
      last_rewards_(sources_.size()),
      returns_(sources_.size()),
      causes_(sources_.size()),
      running_(sources_.size()),
      cut_(sources_.size()) {}

void Futures::begin(const Origin& origin, std::span<const std::uint64_t> streams) {
    if (origin.count == 1)
        std::ranges::fill(sources_, origin.first);
    else
        for (std::size_t k = 0; k < sources_.size(); ++k) sources_[k] = origin.place(streams[k]);
    require_done(simulator_, simulator_.copy_environments(batch_.get(), 0, count(), origin.batch,
                                                          sources_.data()));
    require_done(simulator_, simulator_.set_seeds(batch_.get(), 0, count(), streams.data()));
    look_at_causes(origin.count == 1);
    std::ranges::fill(returns_, 0.0);
    std::ranges::fill(cut_, std::uint8_t{0});
    std::ranges::fill(limits_, no_limit);
    next_limit_ = no_limit;
    made_ = 0;
    discount_ = 1;
}

void Futures::place(const std::byte* states, std::span<const std::int64_t> steps) {
    require_done(simulator_, simulator_.set_state(batch_.get(), 0, count(), states, steps.data()));
    look_at_causes(false);
}

// Where all are copies of one environment, the first one says it for all.
void Futures::look_at_causes(bool are_alike) {
    require_done(simulator_,
                 simulator_.get_causes(batch_.get(), 0, are_alike ? 1 : count(), causes_.data()));
    if (are_alike) {
        const bool is_running = causes_.front() == RDDL_RUNNING;
        std::ranges::fill(causes_, causes_.front());
        std::ranges::fill(running_, static_cast<std::uint8_t>(is_running));
        running_count_ = is_running ? count() : 0;
        return;
    }
    running_count_ = 0;
    for (std::size_t k = 0; k < running_.size(); ++k)
        running_count_ += running_[k] = causes_[k] == RDDL_RUNNING;
}

rddl_transition Futures::outputs() {
    rddl_transition out{};
    out.rewards = rewards_.data();
    out.causes = causes_.data();
    return out;
}

void Futures::step(const std::byte* actions) {
    const rddl_transition out = outputs();
    require_done(simulator_, simulator_.step(batch_.get(), actions, &out));
    take_step();
}

// Loops without branches, since few episodes end.
void Futures::take_step() {
    stepped_ = running_count_;
    // Works on copies of the members: a byte that is stored might else be a part of any of them.
    const std::size_t lanes = returns_.size();
    const std::uint8_t *const causes = causes_.data(), *const running = running_.data();
    double *const rewards = rewards_.data(), *const returns = returns_.data();
    // The batch reports rewards of 0 for those that have ended, but not for those that limits or
    // rewards ended.
    if (running_count_ < count())
        for (std::size_t k = 0; k < lanes; ++k) rewards[k] = running[k] ? rewards[k] : 0;
    constexpr std::size_t group = 32;  // lanes that are looked at again where one of them ends
    const double discount = discount_;
    for (std::size_t first = 0; first < lanes; first += group) {
        const std::size_t last = std::min(first + group, lanes);
        std::uint8_t ends = 0;
        for (std::size_t k = first; k < last; ++k)  // masks, since bytes are multiplied slowly
            ends = static_cast<std::uint8_t>(ends |
                                             (causes[k] & static_cast<std::uint8_t>(-running[k])));
        std::uint64_t bad = 0;  // of differences that are 0 where rewards are finite, else nan
        for (std::size_t k = first; k < last; ++k) {
            bad |= std::bit_cast<std::uint64_t>(rewards[k] - rewards[k]);
            returns[k] += discount * rewards[k];
        }
        if (ends == RDDL_RUNNING && bad == 0) continue;
        if (bad == 0 && !(ends & RDDL_FAULTED))
            end_good(first, last);
        else
            end_any(first, last);
    }
    made_ += 1;
    if (made_ >= next_limit_) end_by_limits();
    discount_ *= simulator_.problem->discount;
}

// Ends each of these lanes that has ended in the batch. No reward is bad, so there is no branch.
void Futures::end_good(std::size_t first, std::size_t last) {
    std::int64_t ended = 0;
    for (std::size_t k = first; k < last; ++k) {
        const bool ends = running_[k] && causes_[k] != RDDL_RUNNING;
        last_rewards_[k] = ends ? rewards_[k] : last_rewards_[k];
        running_[k] = running_[k] && !ends;
        ended += ends;
    }
    running_count_ -= ended;
}

// The same where rewards may be bad, which also ends lanes.
void Futures::end_any(std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
        const bool is_bad = (causes_[k] & RDDL_FAULTED) || !std::isfinite(rewards_[k]);
        if (!running_[k] || (causes_[k] == RDDL_RUNNING && !is_bad)) continue;
        if (is_bad) rewards_[k] = returns_[k] = -std::numeric_limits<double>::infinity();
        last_rewards_[k] = rewards_[k];
        running_[k] = 0;
        running_count_ -= 1;
    }
}

void Futures::end_by_limits() {
    next_limit_ = no_limit;
    for (std::size_t k = 0; k < running_.size(); ++k) {
        if (!running_[k]) continue;
        if (made_ >= limits_[k]) {
            last_rewards_[k] = rewards_[k];
            cut_[k] = 1;
            running_[k] = 0;
            running_count_ -= 1;
        } else {
            next_limit_ = std::min(next_limit_, limits_[k]);
        }
    }
}

}  // namespace rddlc::planners
