#include "planners/cem/near_search.hpp"

#include "planners/cem/cem.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace rddlc::planners {

namespace {

// The effect of an action often pays in the step after it.
constexpr std::int64_t near_horizon = 2;
constexpr double usual_part = 0.25, many_actions = 4096;

double count_of_actions(const solvers::ActionSpace& space) {
    if (space.max_sub_actions > 0)
        return std::pow(static_cast<double>(space.choices.size()), space.max_sub_actions);
    double count = 1;
    for (const solvers::CategoryHead& head : space.categories) count *= head.count;
    return count;
}

CemOptions near_options(CemOptions options, double part) {
    options.horizon = std::min<std::int64_t>(near_horizon, options.horizon.value_or(near_horizon));
    options.near = 0;
    options.policy.clear();
    options.tail = Tail::Policy;
    options.seed += 1;
    if (!options.scenarios) options.scenarios = 1;
    options.budget = share_of(options.budget, part);
    return options;
}

PlannerContext near_context(PlannerContext context, double part) {
    context.base.reset();
    context.memory_limit = share_of(context.memory_limit, part);
    return context;
}

// The part where the user gives none.
double usual_part_of(const CemOptions& options, const solvers::ActionSpace& space) {
    constexpr std::int64_t least_steps = 1000;
    if (options.budget.steps && *options.budget.steps < least_steps) return 0;
    const bool looks_further = !options.horizon || *options.horizon > near_horizon;
    return looks_further && space.reals.empty() && count_of_actions(space) > many_actions
               ? usual_part
               : 0;
}

}  // namespace

double NearSearch::part_of(const CemOptions& options, const solvers::ActionSpace& space) {
    const double part = options.near ? *options.near : usual_part_of(options, space);
    const auto is_too_little = [part](const std::optional<std::int64_t>& limit) {
        return limit && share_of(*limit, part) == 0;
    };
    return is_too_little(options.budget.steps) || is_too_little(options.budget.iterations) ? 0
                                                                                           : part;
}

NearSearch::NearSearch(const PlannerContext& context, const CemOptions& options, double part)
    : search_(std::make_unique<Cem>(near_context(context, part), near_options(options, part))),
      action_(static_cast<std::size_t>(context.simulator.problem->action_size)) {}

NearSearch::~NearSearch() = default;

const std::byte* NearSearch::run(const DecisionPoint& point, BudgetMeter& meter) {
    Explanation explanation;
    search_->decide(point, action_.data(), &explanation);
    meter.add_steps(explanation.steps);
    meter.add_iterations(explanation.iterations);
    return action_.data();
}

void Cem::look_near(const DecisionPoint& point, BudgetMeter& meter) {
    records_.read(near_->run(point, meter), row_.data());
    read_plan_action(space_, row_.data(), near_numbers_.data(), near_indices_.data());
}

// Begins with the best action for the next steps, and goes on as the best plan so far.
void Cem::begin_near(const Memory& memory, Plan& plan) const {
    end_by_noop(plan, 0, memory.horizon);
    if (memory.kept_count > 0)
        plan = memory.kept.front();
    else
        memory.distribution.middle(plan);
    std::ranges::copy(near_numbers_, plan.numbers.begin());
    std::ranges::copy(near_indices_, plan.indices.begin());
}

}  // namespace rddlc::planners
