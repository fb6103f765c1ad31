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
      sums_(sources_.size()),
      causes_(sources_.size()),
      running_(sources_.size()),
      cut_(sources_.size()) {}

void Futures::begin(const Origin& origin, std::span<const std::uint64_t> streams) {
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
    if (are_alike) std::ranges::fill(causes_, causes_.front());
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

// Loops without branches, where no episode ends, no reward is bad and no limit is reached, which is
// most of the time. False, with nothing added, where that is not so.
bool Futures::take_plain_step() {
    if (made_ + 1 >= next_limit_) return false;
    const std::size_t lanes = returns_.size();
    std::uint8_t ends = 0;
    const std::uint8_t *const causes = causes_.data(), *const running = running_.data();
    for (std::size_t k = 0; k < lanes; ++k)  // masks, since bytes are multiplied slowly
        ends =
            static_cast<std::uint8_t>(ends | (causes[k] & static_cast<std::uint8_t>(-running[k])));
    if (ends != RDDL_RUNNING) return false;
    // The batch reports rewards of 0 for those that have ended, but not for those that limits
    // ended.
    if (running_count_ < count())
        for (std::size_t k = 0; k < lanes; ++k) rewards_[k] = running_[k] ? rewards_[k] : 0;
    std::uint64_t bad = 0;  // of differences that are 0 where rewards are finite, else nan
    const double discount = discount_;
    const double *const rewards = rewards_.data(), *const returns = returns_.data();
    double* const sums = sums_.data();
    for (std::size_t k = 0; k < lanes; ++k) {
        bad |= std::bit_cast<std::uint64_t>(rewards[k] - rewards[k]);
        sums[k] = returns[k] + discount * rewards[k];
    }
    if (bad != 0) return false;
    returns_.swap(sums_);
    return true;
}

void Futures::take_step() {
    stepped_ = running_count_;
    if (!take_plain_step()) take_any_step();
    made_ += 1;
    discount_ *= simulator_.problem->discount;
}

// Works on copies of the members: a byte that is stored might else be a part of any of them.
void Futures::take_any_step() {
    const std::int64_t made = made_ + 1;
    const double discount = discount_;
    const std::uint8_t* const causes = causes_.data();
    const std::int64_t* const limits = limits_.data();
    double *const rewards = rewards_.data(), *const returns = returns_.data();
    double* const last_rewards = last_rewards_.data();
    std::uint8_t *const running = running_.data(), *const cut = cut_.data();
    std::int64_t running_count = 0, next_limit = no_limit;
    for (std::size_t k = 0, lanes = running_.size(); k < lanes; ++k) {
        if (!running[k]) {
            rewards[k] = 0;
            continue;
        }
        const bool is_bad = (causes[k] & RDDL_FAULTED) || !std::isfinite(rewards[k]);
        if (is_bad) rewards[k] = -std::numeric_limits<double>::infinity();
        returns[k] += discount * rewards[k];
        last_rewards[k] = rewards[k];
        const bool goes_on = !is_bad && causes[k] == RDDL_RUNNING;
        cut[k] = goes_on && made >= limits[k];
        running_count += running[k] = goes_on && !cut[k];
        if (running[k]) next_limit = std::min(next_limit, limits[k]);
    }
    running_count_ = running_count;
    next_limit_ = next_limit;
}

}  // namespace rddlc::planners
