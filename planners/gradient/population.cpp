#include "planners/gradient/population.hpp"

#include "solvers/batches/batch.hpp"
#include "support/failure.hpp"
#include "support/memory.hpp"

#include <fmt/format.h>

namespace rddlc::planners {

namespace {

// Plans are as many as fit for so many environments, however many there are, so that they are the
// same in any batch.
constexpr double usual_environments = 64;

}  // namespace

GradientPopulation usual_population(const PlannerContext& context, const GradientOptions& options) {
    const bool is_stochastic = context.simulator.problem->stochastic;
    return {static_cast<std::size_t>(options.plans.value_or(is_stochastic ? 2 : 8)),
            is_stochastic ? std::size_t{8} : std::size_t{1}};
}

GradientPopulation population_of(
    const PlannerContext& context, const GradientOptions& options, std::int64_t horizon,
    std::span<const std::unique_ptr<solvers::StepDerivatives>> derivatives, std::size_t ways) {
    const auto steps = static_cast<double>(horizon);
    double fixed = 0;
    for (const auto& each : derivatives)
        fixed +=
            static_cast<double>(each->bytes()) +
            (steps + 1) * static_cast<double>(each->state_count() * sizeof(solvers::LaneNumbers));
    const double of_parameters =
        steps * static_cast<double>(derivatives.front()->action_count() * sizeof(double));
    const auto of_lane = static_cast<double>(solvers::bytes_per_environment(context.simulator));
    const auto bytes = [&](const GradientPopulation& each, double environments) {
        // A gradient, and in each environment the parameters with the two averages of Adam.
        const double of_plan = of_parameters * (1 + 3 * environments);
        const auto plans = static_cast<double>(derivatives.size() * each.plans);
        const double candidates = plans * static_cast<double>(ways) + 2;  // no-op and the policy
        return fixed + plans * of_plan + candidates * static_cast<double>(each.draws) * of_lane;
    };
    GradientPopulation population = usual_population(context, options);
    // Threads have a planner each, and so share the limit.
    const auto limit = static_cast<double>(context.memory_limit);
    const auto is_large = [&] {
        return bytes(population, usual_environments) > limit / 4;
    };
    while (population.plans > 1 && is_large()) --population.plans;
    while (population.draws > 1 && is_large()) --population.draws;
    const double taken = bytes(population, static_cast<double>(context.environments));
    if (taken > limit)
        throw Failure(fmt::format("plan:gradient takes {} with one plan, which is more than {}",
                                  memory_text(taken), memory_text(limit)),
                      "a shorter horizon=N, one kind of relax=HOW, or plan:cem takes less");
    return population;
}

}  // namespace rddlc::planners
