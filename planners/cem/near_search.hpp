// Plans of two steps: where a joint action consists of many choices, and most of them pay at once,
// plans of many steps are too few, and their rewards too noisy, to tell good choices from bad ones.
#pragma once

#include "planners/cem/cem_options.hpp"
#include "planners/planner/planner.hpp"
#include "planners/simulation/budget.hpp"
#include "solvers/spaces/actions.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace rddlc::planners {

class Cem;

class NearSearch {
  public:
    // The part of the budget and of the memory that it takes, by the options and the actions; 0:
    // none, also where that would be less than one step or one iteration.
    static double part_of(const CemOptions& options, const solvers::ActionSpace& space);

    // The rest of the whole, for all other plans.
    static std::int64_t rest(double part, std::int64_t whole) {
        return whole - share_of(whole, part);
    }
    static std::optional<std::int64_t> rest(double part, std::optional<std::int64_t> whole) {
        return whole ? std::optional(rest(part, *whole)) : whole;
    }

    // It takes that part of both.
    NearSearch(const PlannerContext& context, const CemOptions& options, double part);
    ~NearSearch();

    // The action record that begins the best plan. Its steps and iterations count in `meter`.
    const std::byte* run(const DecisionPoint& point, BudgetMeter& meter);

  private:
    std::unique_ptr<Cem> search_;
    std::vector<std::byte> action_;
};

}  // namespace rddlc::planners
