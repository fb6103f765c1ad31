#include "solvers/spaces/refusals.hpp"

#include "solvers/spaces/actions.hpp"
#include "support/failure.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rddlc::solvers {

namespace {

template <class Work>
std::optional<std::string> sentence_of(const Work& work) {
    try {
        work();
    } catch (const Failure& failure) {
        return failure.what();
    }
    return std::nullopt;
}

}  // namespace

bool is_endless(const rddl_problem& problem, std::int64_t horizon) {
    return horizon == 0 && problem.termination_count == 0 && problem.invariant_count == 0;
}

void require_an_end_to_learn(const rddl_problem& problem) {
    if (is_endless(problem, problem.horizon)) throw Failure(endless);
}

void require_a_gradient_to_learn(const rddl_simulator& simulator, std::int64_t horizon) {
    const rddl_problem& problem = *simulator.problem;
    if (horizon == 0)
        throw Failure("gradients go back from the end of episodes, and this problem has no horizon",
                      "give one: --horizon N", usage_error);
    if (problem.partially_observed)
        throw Failure(
            fmt::format("'rddl train drp' needs the state, which {} ({}) hides from policies",
                        problem.instance, problem.domain),
            "'rddl train ppo --recurrent 32' learns from observations");
    const auto is_object = [](const rddl_column& column) {
        return column.object_count > 0;
    };
    if (std::ranges::all_of(action_columns(simulator), is_object))
        throw Failure(
            "the return has no derivative by the actions of this problem: all are objects",
            "'rddl train ppo' and 'rddl train cgp' need no derivatives");
}

Refusals refusals(const rddl_simulator& simulator,
                  const std::optional<std::string>& no_derivatives) {
    // CGP ends episodes by itself.
    const auto by_actions = sentence_of([&] { require_choices(simulator); });
    const auto by_end = sentence_of([&] { require_an_end_to_learn(*simulator.problem); });
    const auto by_gradient = sentence_of(
        [&] { require_a_gradient_to_learn(simulator, simulator.problem->horizon); });
    return {by_end ? by_end : by_actions, by_actions,
            by_actions    ? by_actions
            : by_gradient ? by_gradient
                          : no_derivatives};
}

}  // namespace rddlc::solvers
