// plan:cem, as long as none of its plans is better than doing nothing.
#include "planners/cem/cem.hpp"

#include <algorithm>

namespace rddlc::planners {

namespace {

constexpr std::int64_t most_lanes = 1024, least_lanes = 16;
constexpr std::int64_t longest_search = 1000;

// The lanes of a novelty search that takes a part of the budget, and of the memory.
std::int64_t novelty_lanes(const rddl_simulator& simulator, const CemOptions& options,
                           std::int64_t batch_horizon, std::int64_t memory_limit,
                           std::int64_t steps_limit, std::int64_t action_values) {
    constexpr std::int64_t parts = 4, usual_horizon = 100;
    std::int64_t steps = solvers::steps_of_horizon(*simulator.problem, batch_horizon);
    if (steps == 0) steps = usual_horizon;
    steps = std::min(steps, options.horizon.value_or(longest_lookahead));
    const std::int64_t bytes =
        solvers::bytes_per_environment(simulator) + steps * action_values * 4;
    const std::int64_t affordable =
        std::min(steps_limit / (parts * steps), memory_limit / (parts * bytes));
    return std::clamp(affordable, least_lanes, most_lanes);
}

}  // namespace

bool Cem::look_elsewhere(Memory& memory, const DecisionPoint& point, RandomStream& stream,
                         BudgetMeter& meter) {
    const std::int64_t most =
        std::min(point.left, options_.horizon ? memory.horizon : longest_lookahead);
    if (memory.horizon < most)
        look_further(memory, most);
    else if (!is_fresh(memory))
        return look_for_rare_states(memory, point, stream, meter);
    return false;
}

void Cem::look_further(Memory& memory, std::int64_t most) const {
    const std::int64_t before = memory.horizon;
    memory.horizon = std::min(2 * before, most);
    memory.distribution.extend(memory.horizon);
    for (std::size_t k = 0; k < memory.kept_count; ++k)
        end_by_noop(memory.kept[k], before, memory.horizon);
}

// A course that is better than doing nothing is the first of the plans that are kept.
bool Cem::look_for_rare_states(Memory& memory, const DecisionPoint& point, RandomStream& stream,
                               BudgetMeter& meter) {
    const std::int64_t steps = std::min({point.left, memory.horizon, longest_search});
    if (!novelty_search_)
        novelty_search_.emplace(simulator_, space_, records_, correlations_of(options_),
                                novelty_lanes(simulator_, options_, batch_horizon_, memory_limit_,
                                              steps_limit_.value_or(most_steps),
                                              space_.real_count() + space_.index_count()),
                                batch_horizon_);
    const auto lanes = novelty_search_->lanes() + static_cast<std::int64_t>(lanes_);
    if (!meter.has_room(lanes * steps, 0)) return false;
    end_by_noop(plan_, 0, memory.horizon);
    const auto value = novelty_search_->run(point, steps, stream, meter, plan_);
    if (!value || !(*value > noop_value_)) return false;
    memory.distribution.centre_on(plan_);
    memory.kept_count = std::min(memory.kept.size(), memory.kept_count + 1);
    const auto begin = memory.kept.begin();
    std::rotate(begin, begin + static_cast<std::ptrdiff_t>(memory.kept_count) - 1,
                begin + static_cast<std::ptrdiff_t>(memory.kept_count));
    std::shift_right(memory.kept_values.begin(), memory.kept_values.end(), 1);
    memory.kept.front() = plan_;
    memory.kept_values.front() = {*value, 0};
    return true;
}

}  // namespace rddlc::planners
