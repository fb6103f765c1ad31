#include "planners/simulation/futures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rddlc::planners {

using solvers::require_done;

namespace {

solvers::BatchHandle batch_of(const rddl_simulator& simulator, std::int64_t count,
                              std::int64_t horizon) {
    rddl_batch_options options{};
    options.environment_count = count;
    options.thread_count = 1;  // episodes are planned for side by side
    options.horizon = horizon;
    return solvers::create_batch(simulator, options);
}

}  // namespace

Futures::Futures(const rddl_simulator& simulator, std::int64_t count, std::int64_t horizon)
    : simulator_(simulator),
      batch_(batch_of(simulator, count, horizon)),
      sources_(static_cast<std::size_t>(count)),
      limits_(sources_.size()),
      rewards_(sources_.size()),
      last_rewards_(sources_.size()),
      returns_(sources_.size()),
      causes_(sources_.size()),
      running_(sources_.size()),
      cut_(sources_.size()) {}

void Futures::begin(const rddl_batch* from, std::int64_t place,
                    std::span<const std::uint64_t> streams) {
    std::ranges::fill(sources_, place);
    require_done(simulator_,
                 simulator_.copy_environments(batch_.get(), 0, count(), from, sources_.data()));
    require_done(simulator_, simulator_.set_seeds(batch_.get(), 0, count(), streams.data()));
    look_at_causes();
    std::ranges::fill(returns_, 0.0);
    std::ranges::fill(cut_, std::uint8_t{0});
    std::ranges::fill(limits_, std::numeric_limits<std::int64_t>::max());
    has_limits_ = false;
    discount_ = 1;
}

void Futures::place(const std::byte* states, std::span<const std::int64_t> steps) {
    require_done(simulator_, simulator_.set_state(batch_.get(), 0, count(), states, steps.data()));
    look_at_causes();
}

void Futures::look_at_causes() {
    require_done(simulator_, simulator_.get_causes(batch_.get(), 0, count(), causes_.data()));
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

void Futures::step_values(const float* actions) {
    const rddl_transition out = outputs();
    require_done(simulator_,
                 simulator_.step_values(batch_.get(), RDDL_FLOAT, actions, nullptr, &out));
    take_step();
}

// Where all run, no reward is bad and no episode ends, which is most of the time: a loop without
// branches.
bool Futures::take_plain_step() {
    if (running_count_ != count() || has_limits_) return false;
    std::uint8_t ends = 0;
    for (const std::uint8_t cause : causes_) ends |= cause;
    if (ends != RDDL_RUNNING) return false;
    std::int64_t bad = 0;
    for (const double reward : rewards_) bad += reward - reward == 0 ? 0 : 1;
    if (bad > 0) return false;
    const double discount = discount_;
    for (std::size_t k = 0; k < returns_.size(); ++k) returns_[k] += discount * rewards_[k];
    stepped_ = running_count_;
    discount_ *= simulator_.problem->discount;
    return true;
}

void Futures::take_step() {
    if (take_plain_step()) return;
    stepped_ = running_count_;
    running_count_ = 0;
    for (std::size_t k = 0; k < running_.size(); ++k) {
        if (!running_[k]) {
            rewards_[k] = 0;
            continue;
        }
        const bool is_bad = (causes_[k] & RDDL_FAULTED) || !std::isfinite(rewards_[k]);
        if (is_bad) rewards_[k] = -std::numeric_limits<double>::infinity();
        returns_[k] += discount_ * rewards_[k];
        last_rewards_[k] = rewards_[k];
        const bool goes_on = !is_bad && causes_[k] == RDDL_RUNNING;
        cut_[k] = goes_on && --limits_[k] <= 0;
        running_count_ += running_[k] = goes_on && !cut_[k];
    }
    discount_ *= simulator_.problem->discount;
}

}  // namespace rddlc::planners
