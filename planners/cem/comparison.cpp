// The end of a decision of plan:cem: the best plans are compared by new random streams.
#include "planners/cem/cem.hpp"
#include "planners/simulation/mean_and_error.hpp"

#include <algorithm>
#include <cmath>

namespace rddlc::planners {

namespace {

// Standard errors by which a plan has to be better than the policy to be taken in its place.
constexpr double doubt = 1;

}  // namespace

// After the plans comes what the policy does.
void Cem::play_tail(const DecisionPoint& point, std::int64_t steps, BudgetMeter& meter) {
    if (!base_ || tail_ || point.left == no_end) return;
    std::ranges::fill(by_policy_, 1);
    for (std::int64_t t = steps; t < point.left && futures_.any_running(); ++t) {
        if (meter.is_late()) return;
        base_->act(futures_, by_policy_, actions_.data(), point.stops);
        futures_.step(actions_.data());
        meter.add_steps(futures_.stepped());
    }
}

// Compares the best plans, no-op, the policy and the middle, by random streams that did not select
// any of them.
Cem::Choice Cem::compare(const DecisionPoint& point, std::int64_t steps, RandomStream& stream,
                         BudgetMeter& meter) {
    compared_.clear();
    for (std::size_t k = 0; k < std::min(most_compared, population_); ++k)
        compared_.push_back(static_cast<std::uint32_t>(order_[k]));
    for (std::uint32_t c = 0; c < population_; ++c)
        if (origins_[c] != Origin::Sample && origins_[c] != Origin::Kept &&
            std::ranges::find(compared_, c) == compared_.end())
            compared_.push_back(c);
    const std::size_t count = compared_.size(), draws = lanes_ / count;
    const Choice unsure{order_.front(), values_[order_.front()], errors_[order_.front()],
                        static_cast<std::int64_t>(scenarios_)};
    if (draws == 0) return unsure;
    std::size_t policy = count;
    draw_streams(stream, count);
    for (std::size_t k = 0; k < lanes_; ++k) {
        by_policy_[k] = origins_[compared_[k % count]] == Origin::Policy;
        if (by_policy_[k]) policy = k % count;
    }
    const bool is_done = play(point, compared_, steps, meter) == steps;
    if (is_done) play_tail(point, steps, meter);
    std::ranges::fill(by_policy_, 0);
    if (!is_done || meter.is_late()) return unsure;

    std::size_t best = 0;
    compared_values_.clear();
    compared_errors_.clear();
    for (std::size_t c = 0; c < count; ++c) {
        const auto found =
            mean_and_error(draws, [&](std::size_t s) { return futures_.value(s * count + c); });
        compared_values_.push_back(found.mean);
        compared_errors_.push_back(found.error);
        if (found.mean > compared_values_[best]) best = c;
    }
    if (policy < count && best != policy) {
        const auto better = mean_and_error(draws, [&](std::size_t s) {
            return futures_.value(s * count + best) - futures_.value(s * count + policy);
        });
        if (std::isfinite(compared_values_[policy]) && better.mean < doubt * better.error)
            best = policy;
    }
    for (std::size_t c = 0; c < count; ++c) {  // for those who ask what was thought
        values_[compared_[c]] = compared_values_[c];
        errors_[compared_[c]] = compared_errors_[c];
    }
    return {compared_[best], compared_values_[best], compared_errors_[best],
            static_cast<std::int64_t>(draws)};
}

void Cem::note_candidates(Explanation& explanation, const Choice& chosen) const {
    constexpr const char* names[] = {"kept", "policy", "noop", "middle", "near", "sample"};
    constexpr std::size_t most = 5;
    const auto add = [&](std::size_t plan, std::int64_t trials) {
        const std::byte* const action = first_action(plan);
        explanation.candidates.push_back({names[static_cast<std::size_t>(origins_[plan])],
                                          {action, action + records_.record_size()},
                                          values_[plan],
                                          errors_[plan],
                                          trials});
    };
    add(chosen.plan, chosen.trials);
    explanation.candidates.front().value = chosen.value;
    for (std::size_t k = 0; k < population_; ++k) {
        const std::size_t plan = order_[k];
        const bool is_special = origins_[plan] != Origin::Sample && origins_[plan] != Origin::Kept;
        if (plan != chosen.plan && (k < most || is_special)) add(plan, chosen.trials);
    }
}

}  // namespace rddlc::planners
