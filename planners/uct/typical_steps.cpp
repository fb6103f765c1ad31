#include "planners/uct/typical_steps.hpp"

#include "planners/uct/state_hash.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace rddlc::planners {

namespace {

constexpr std::size_t wanted_lanes = 512;
constexpr std::size_t most_lanes = 4096;

std::size_t draws_of(const rddl_simulator& simulator, std::size_t actions) {
    if (!simulator.problem->stochastic) return 1;
    return std::clamp<std::size_t>(most_lanes / actions, 1, most_typical_draws);
}

// Each episode is over after the one step that counts, so that lanes which are not wanted the next
// time cost nothing.
solvers::BatchHandle one_step_batch(const rddl_simulator& simulator, std::size_t count) {
    rddl_batch_options options{};
    options.environment_count = static_cast<std::int64_t>(count);
    options.thread_count = 1;
    options.horizon = 1;
    return solvers::create_batch(simulator, options);
}

std::size_t differing_bytes(const std::byte* a, const std::byte* b, std::size_t size) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < size; ++i) count += a[i] != b[i];
    return count;
}

}  // namespace

TypicalSteps::TypicalSteps(const rddl_simulator& simulator, const FiniteActions& actions,
                           std::uint64_t seed)
    : simulator_(simulator),
      actions_(actions),
      seed_(scrambled(seed)),
      state_size_(static_cast<std::size_t>(simulator.problem->state_size)),
      draws_(draws_of(simulator, actions.count())),
      most_states_(std::max<std::size_t>(1, wanted_lanes / (actions.count() * draws_))),
      batch_(one_step_batch(simulator, most_states_ * actions.count() * draws_)) {
    const std::size_t lanes = most_states_ * actions.count() * draws_;
    states_.resize(lanes * state_size_);
    next_.resize(lanes * state_size_);
    steps_.resize(lanes);
    streams_.resize(lanes);
    rewards_.resize(lanes);
    causes_.resize(lanes);
    violated_.resize(lanes, -1);
    legal_.resize(most_states_ * actions.count());
    const auto size = static_cast<std::size_t>(simulator.problem->action_size);
    records_.resize(lanes * size);
    for (std::size_t k = 0; k < lanes; ++k)
        std::copy_n(actions.record(k / draws_ % actions.count()), size, records_.data() + k * size);
}

void TypicalSteps::run(std::span<const std::byte* const> states) {
    for (std::size_t s = 0; s < states.size(); ++s) {
        const std::uint64_t key = hash_of(states[s], state_size_) ^ seed_;
        for (std::size_t a = 0; a < actions_.count(); ++a)
            for (std::size_t d = 0; d < draws_; ++d) {
                const std::size_t k = lane(s, a, d);
                std::copy_n(states[s], state_size_, states_.data() + k * state_size_);
                streams_[k] = scrambled(key + d);  // the same for all actions
            }
    }
    const std::size_t used = states.size() * actions_.count() * draws_;
    const auto count = static_cast<std::int64_t>(used);
    rddl_batch* const batch = batch_.get();
    using solvers::require_done;
    require_done(simulator_, simulator_.set_seeds(batch, 0, count, streams_.data()));
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
            any |= legal[a] = violated_[lane(s, a, 0)] < 0;
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
    double sum = 0;
    for (std::size_t d = 0; d < draws_; ++d) {
        const std::size_t k = lane(state, action, d);
        if (has_failed(k)) return -std::numeric_limits<double>::infinity();
        sum += rewards_[k];
    }
    return sum / static_cast<double>(draws_);
}

// The one whose state differs least from those of the others.
std::size_t TypicalSteps::typical_draw(std::size_t state, std::size_t action) const {
    std::size_t differences[most_typical_draws] = {};
    for (std::size_t d = 1; d < draws_; ++d)
        for (std::size_t other = 0; other < d; ++other) {
            const std::size_t count =
                differing_bytes(next_state(lane(state, action, d)),
                                next_state(lane(state, action, other)), state_size_);
            differences[d] += count;
            differences[other] += count;
        }
    return static_cast<std::size_t>(std::min_element(differences, differences + draws_) -
                                    differences);
}

const std::byte* TypicalSteps::next(std::size_t state, std::size_t action) const {
    const std::size_t k = lane(state, action, typical_draw(state, action));
    return is_over(k) ? nullptr : next_state(k);
}

bool TypicalSteps::is_unchanged(std::size_t state, std::size_t action) const {
    for (std::size_t d = 0; d < draws_; ++d) {
        const std::size_t k = lane(state, action, d);
        if (is_over(k) || rewards_[k] != rewards_[lane(state, action, 0)] ||
            std::memcmp(next_state(k), states_.data() + k * state_size_, state_size_) != 0)
            return false;
    }
    return true;
}

}  // namespace rddlc::planners
