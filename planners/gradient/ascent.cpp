#include "planners/gradient/ascent.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rddlc::planners {

namespace {

constexpr std::size_t group_size = solvers::derivative_lanes;
// Steps between two looks at the stops.
constexpr std::size_t steps_between_looks = 64;

bool must_end(std::size_t step, const solvers::Stops* stops) {
    return step % steps_between_looks == 0 && solvers::is_stopped(stops);
}

// Adam also adds squares up, of which infinitely large ones would leave nan.
bool can_be_squared(double derivative) {
    return std::isfinite(derivative * derivative);
}

}  // namespace

Ascent::Ascent(const ActionParameters& actions, solvers::StepDerivatives& derivatives,
               std::size_t scenarios, double discount)
    : actions_(actions),
      derivatives_(derivatives),
      scenarios_(scenarios),
      discount_(discount),
      row_(derivatives.action_count()),
      action_(derivatives.action_count()),
      adjoint_(derivatives.state_count()),
      next_adjoint_(derivatives.state_count()),
      action_adjoint_(derivatives.action_count()) {}

bool Ascent::improve(std::span<AscendingPlan* const> plans, std::span<const double> state,
                     std::int64_t steps_made, std::int64_t horizon,
                     std::span<const std::uint64_t> seeds, double rate, std::int64_t iteration,
                     const solvers::Stops* stops) {
    const std::size_t row = static_cast<std::size_t>(horizon) * actions_.count();
    gradients_.assign(plans.size() * row, 0.0);
    values_.assign(plans.size(), 0.0);
    const std::size_t all = plans.size() * scenarios_;
    for (std::size_t first = 0; first < all; first += group_size) {
        begin_group(first, std::min(group_size, all - first), seeds);
        const std::size_t steps =
            play(plans, state, steps_made, static_cast<std::size_t>(horizon), stops);
        for (std::size_t k = 0; k < group_size_; ++k)
            values_[(first + k) / scenarios_] += returns_[k] / static_cast<double>(scenarios_);
        pull_back(plans, steps_made, steps, stops);
        if (solvers::is_stopped(stops)) return false;
    }
    for (std::size_t p = 0; p < plans.size(); ++p) {
        plans[p]->value = values_[p];
        move(*plans[p], std::span(gradients_).subspan(p * row, row), rate, iteration);
    }
    return true;
}

void Ascent::begin_group(std::size_t first, std::size_t lane_count,
                         std::span<const std::uint64_t> seeds) {
    group_first_ = first;
    group_size_ = lane_count;
    std::array<std::uint64_t, group_size> lane_seeds{};
    for (std::size_t k = 0; k < lane_count; ++k) lane_seeds[k] = seeds[(first + k) % scenarios_];
    derivatives_.set_seeds(lane_seeds);
}

void Ascent::write_actions(std::span<AscendingPlan* const> plans, std::size_t step) {
    for (std::size_t k = 0; k < group_size; ++k) {
        const std::size_t lane = group_first_ + std::min(k, group_size_ - 1);
        const double* const row =
            plans[lane / scenarios_]->parameters.data() + step * actions_.count();
        actions_.values({row, actions_.count()}, row_);
        for (std::size_t i = 0; i < actions_.count(); ++i) action_[i][k] = row_[i];
    }
}

// Returns the steps that are made, until the last episode ends or the stops say so.
std::size_t Ascent::play(std::span<AscendingPlan* const> plans, std::span<const double> state,
                         std::int64_t steps_made, std::size_t horizon,
                         const solvers::Stops* stops) {
    const std::size_t count = state.size();
    states_.resize((horizon + 1) * count);
    reward_weight_.assign(horizon, Lane{});
    for (std::size_t i = 0; i < count; ++i) states_[i].fill(state[i]);
    Lane alive{};
    std::fill_n(alive.begin(), group_size_, 1.0);
    returns_ = {};
    double discount = 1;
    for (std::size_t t = 0; t < horizon; ++t, discount *= discount_) {
        if (must_end(t, stops)) return t;
        write_actions(plans, t);
        const std::span now = std::span(states_).subspan(t * count, count);
        derivatives_.step(steps_made + static_cast<std::int64_t>(t), now, action_);
        derivatives_.read_next(std::span(states_).subspan((t + 1) * count, count));
        const Lane reward = derivatives_.reward();
        bool any = false;
        for (std::size_t k = 0; k < group_size; ++k) {
            if (derivatives_.has_failed(k) || !std::isfinite(reward[k])) alive[k] = 0;
            reward_weight_[t][k] = alive[k] * discount;
            if (alive[k] != 0) returns_[k] += discount * reward[k];
            if (derivatives_.is_over(k)) alive[k] = 0;
            any = any || alive[k] != 0;
        }
        if (!any) return t + 1;
    }
    return horizon;
}

// Values of each step are computed again, so that memory holds its states alone.
void Ascent::pull_back(std::span<AscendingPlan* const> plans, std::int64_t steps_made,
                       std::size_t steps, const solvers::Stops* stops) {
    const std::size_t count = derivatives_.state_count();
    const std::size_t row = gradients_.size() / plans.size();
    std::ranges::fill(next_adjoint_, Lane{});
    for (std::size_t t = steps; t-- > 0;) {
        if (must_end(t, stops)) return;
        write_actions(plans, t);
        derivatives_.step(steps_made + static_cast<std::int64_t>(t),
                          std::span(states_).subspan(t * count, count), action_);
        derivatives_.pull_back(next_adjoint_, reward_weight_[t], adjoint_, action_adjoint_);
        for (std::size_t k = 0; k < group_size_; ++k) {
            const std::size_t plan = (group_first_ + k) / scenarios_;
            double* const gradient = gradients_.data() + plan * row + t * actions_.count();
            const double* const parameters = plans[plan]->parameters.data() + t * actions_.count();
            for (std::size_t i = 0; i < actions_.count(); ++i) row_[i] = action_adjoint_[i][k];
            actions_.pull_back({parameters, actions_.count()}, row_, {gradient, actions_.count()});
            // An episode that was over before has no part in what comes before.
            if (reward_weight_[t][k] == 0)
                for (Lane& adjoint : adjoint_) adjoint[k] = 0;
        }
        next_adjoint_.swap(adjoint_);
    }
}

void Ascent::move(AscendingPlan& plan, std::span<const double> gradient, double rate,
                  std::int64_t iteration) {
    constexpr double mean_decay = 0.9, square_decay = 0.99;
    const auto n = static_cast<double>(iteration + 1);
    const double mean_scale = 1 - std::pow(mean_decay, n);
    const double square_scale = 1 - std::pow(square_decay, n);
    for (std::size_t j = 0; j < gradient.size(); ++j) {
        if (!can_be_squared(gradient[j])) continue;
        plan.mean[j] += (1 - mean_decay) * (gradient[j] - plan.mean[j]);
        plan.square[j] += (1 - square_decay) * (gradient[j] * gradient[j] - plan.square[j]);
    }
    const std::size_t count = actions_.count();
    for (std::size_t begin = 0; begin < gradient.size(); begin += count) {
        std::copy_n(plan.square.begin() + static_cast<std::ptrdiff_t>(begin), count, row_.begin());
        actions_.share_scales(row_);
        for (std::size_t i = 0; i < count; ++i) {
            if (!can_be_squared(gradient[begin + i])) continue;
            plan.parameters[begin + i] += rate * (plan.mean[begin + i] / mean_scale) /
                                          (std::sqrt(row_[i] / square_scale) + 1e-12);
        }
        actions_.project(std::span(plan.parameters).subspan(begin, count));
    }
}

}  // namespace rddlc::planners
