#include "planners/gradient/population.hpp"

#include "solvers/batches/batch.hpp"
#include "support/failure.hpp"
#include "support/memory.hpp"

#include <fmt/format.h>

namespace rddlc::planners {

GradientPopulation population_of(
    const PlannerContext& context, const GradientOptions& options, std::int64_t horizon,
    std::span<const std::unique_ptr<solvers::StepDerivatives>> derivatives, std::size_t ways) {
    const auto steps = static_cast<double>(horizon);
    double fixed = 0;
    for (const auto& each : derivatives)
        fixed +=
            static_cast<double>(each->bytes()) +
            (steps + 1) * static_cast<double>(each->state_count() * sizeof(solvers::LaneNumbers));
    // A gradient, and in each environment the parameters with the two averages of Adam.
    const double of_plan =
        steps * static_cast<double>(derivatives.front()->action_count() * sizeof(double)) *
        (1 + 3 * static_cast<double>(context.environments));
    const auto of_lane = static_cast<double>(solvers::bytes_per_environment(context.simulator));
    const auto bytes = [&](const GradientPopulation& each) {
        const auto plans = static_cast<double>(derivatives.size() * each.plans);
        const double candidates = plans * static_cast<double>(ways) + 2;  // no-op and the policy
        return fixed + plans * of_plan + candidates * static_cast<double>(each.draws) * of_lane;
    };
    const bool is_stochastic = context.simulator.problem->stochastic;
    GradientPopulation population{
        static_cast<std::size_t>(options.plans.value_or(is_stochastic ? 2 : 8)),
        is_stochastic ? std::size_t{8} : std::size_t{1}};
    // Threads have a planner each, and so share the limit.
    const auto limit = static_cast<double>(context.memory_limit);
    while (population.plans > 1 && bytes(population) > limit / 4) --population.plans;
    while (population.draws > 1 && bytes(population) > limit / 4) --population.draws;
    if (bytes(population) > limit)
        throw Failure(fmt::format("plan:gradient takes {} with one plan, which is more than {}",
                                  memory_text(bytes(population)), memory_text(limit)),
                      "a shorter horizon=N, one kind of relax=HOW, or plan:cem takes less");
    return population;
}

}  // namespace rddlc::planners
