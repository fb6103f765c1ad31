#include "planners/uct/typical_steps.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace rddlc::planners {

namespace {

constexpr std::size_t wanted_lanes = 512;

// Each episode is over after the one step that counts, so that lanes which are not wanted the next
// time cost nothing.
solvers::BatchHandle one_step_batch(const rddl_simulator& simulator, std::size_t count) {
    rddl_batch_options options{};
    options.environment_count = static_cast<std::int64_t>(count);
    options.thread_count = 1;
    options.horizon = 1;
    return solvers::create_batch(simulator, options);
}

}  // namespace

TypicalSteps::TypicalSteps(const rddl_simulator& simulator, const FiniteActions& actions)
    : simulator_(simulator),
      actions_(actions),
      state_size_(static_cast<std::size_t>(simulator.problem->state_size)),
      most_states_(std::max<std::size_t>(1, wanted_lanes / actions.count())),
      batch_(one_step_batch(simulator, most_states_ * actions.count())) {
    const std::size_t lanes = most_states_ * actions.count();
    states_.resize(lanes * state_size_);
    next_.resize(lanes * state_size_);
    steps_.resize(lanes);
    rewards_.resize(lanes);
    causes_.resize(lanes);
    violated_.resize(lanes, -1);
    legal_.resize(lanes);
    const auto size = static_cast<std::size_t>(simulator.problem->action_size);
    records_.resize(lanes * size);
    for (std::size_t k = 0; k < lanes; ++k)
        std::copy_n(actions.record(k % actions.count()), size, records_.data() + k * size);
    solvers::require_done(
        simulator, simulator.draw_medians(batch_.get(), 0, static_cast<std::int64_t>(lanes)));
}

void TypicalSteps::run(std::span<const std::byte* const> states) {
    for (std::size_t s = 0; s < states.size(); ++s)
        for (std::size_t a = 0; a < actions_.count(); ++a)
            std::copy_n(states[s], state_size_, states_.data() + lane(s, a) * state_size_);
    const auto count = static_cast<std::int64_t>(states.size() * actions_.count());
    rddl_batch* const batch = batch_.get();
    using solvers::require_done;
    require_done(simulator_, simulator_.set_state(batch, 0, count, states_.data(), steps_.data()));
    find_legal(states.size());
    rddl_transition out{};
    out.rewards = rewards_.data();
    out.causes = causes_.data();
    require_done(simulator_, simulator_.step(batch, records_.data(), &out));
    require_done(simulator_, simulator_.get_state(batch, 0, count, next_.data()));
}

// If no action is legal, all are taken for legal.
void TypicalSteps::find_legal(std::size_t count) {
    std::ranges::fill(legal_, std::uint8_t{1});
    if (!actions_.may_be_illegal()) return;
    solvers::require_done(simulator_, simulator_.violated_preconditions(
                                          batch_.get(), records_.data(), violated_.data()));
    for (std::size_t s = 0; s < count; ++s) {
        bool any = false;
        std::uint8_t* const legal = legal_.data() + s * actions_.count();
        for (std::size_t a = 0; a < actions_.count(); ++a)
            any |= legal[a] = violated_[lane(s, a)] < 0;
        if (!any) std::fill_n(legal, actions_.count(), std::uint8_t{1});
    }
}

bool TypicalSteps::is_legal(std::size_t state, std::size_t action) const {
    return legal_[state * actions_.count() + action] != 0;
}

bool TypicalSteps::is_over(std::size_t k) const {
    return (causes_[k] & ~RDDL_TRUNCATED_HORIZON) != RDDL_RUNNING;
}

bool TypicalSteps::has_failed(std::size_t k) const {
    return (causes_[k] & RDDL_FAULTED) || !std::isfinite(rewards_[k]);
}

double TypicalSteps::reward(std::size_t state, std::size_t action) const {
    const std::size_t k = lane(state, action);
    return has_failed(k) ? -std::numeric_limits<double>::infinity() : rewards_[k];
}

const std::byte* TypicalSteps::next(std::size_t state, std::size_t action) const {
    const std::size_t k = lane(state, action);
    return is_over(k) ? nullptr : next_state(k);
}

bool TypicalSteps::is_unchanged(std::size_t state, std::size_t action) const {
    const std::size_t k = lane(state, action);
    return !is_over(k) &&
           std::memcmp(next_state(k), states_.data() + k * state_size_, state_size_) == 0;
}

}  // namespace rddlc::planners
