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

bool is_endless(const rddl_problem& problem, std::int64_t horizon) {
    return horizon == 0 && problem.termination_count == 0 && problem.invariant_count == 0;
}

void require_an_end_to_learn(const rddl_problem& problem) {
    if (is_endless(problem, problem.horizon)) throw Failure(endless);
}

Refusals refusals(const rddl_simulator& simulator) {
    // CGP ends episodes by itself.
    const auto by_actions = sentence_of([&] { require_choices(simulator); });
    const auto by_end = sentence_of([&] { require_an_end_to_learn(*simulator.problem); });
    return {by_end ? by_end : by_actions, by_actions};
}

}  // namespace rddlc::solvers
