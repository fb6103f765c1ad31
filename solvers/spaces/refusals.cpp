#include "solvers/spaces/refusals.hpp"

#include "solvers/spaces/actions.hpp"
#include "support/failure.hpp"

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

void require_an_end_to_learn(const rddl_problem& problem) {
    if (problem.horizon == 0 && problem.termination_count == 0 && problem.invariant_count == 0)
        throw Failure(
            "nothing ends an episode of this problem: it has no horizon, no termination "
            "and no invariant");
}

Refusals refusals(const rddl_simulator& simulator) {
    // CGP ends episodes by itself.
    const auto by_actions = sentence_of([&] { require_choices(simulator); });
    const auto by_end = sentence_of([&] { require_an_end_to_learn(*simulator.problem); });
    return {by_end ? by_end : by_actions, by_actions};
}

}  // namespace rddlc::solvers
