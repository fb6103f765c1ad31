// How many plans plan:gradient improves at once.
#pragma once

#include "planners/gradient/gradient_options.hpp"
#include "planners/planner/planner.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace rddlc::planners {

struct GradientPopulation {
    std::size_t plans;  // by each relaxation
    std::size_t draws;  // of each candidate's comparison
};

// As many as the options say.
GradientPopulation usual_population(const PlannerContext& context, const GradientOptions& options);

// The same, or fewer that fit into memory. `horizon`: steps of a plan. Each plan is `ways`
// candidates. Throws a Failure where a single plan does not fit.
GradientPopulation population_of(
    const PlannerContext& context, const GradientOptions& options, std::int64_t horizon,
    std::span<const std::unique_ptr<solvers::StepDerivatives>> derivatives, std::size_t ways);

}  // namespace rddlc::planners
