#include "exact/step_outcomes.hpp"

#include "ir/analysis.hpp"
#include "support/failure.hpp"

#include <algorithm>

namespace rddlc::workbench {

namespace {

rddl::Context<rddl::Scalar> context_at(std::int64_t steps) {
    return rddl::Context<rddl::Scalar>::of(0, 0, static_cast<std::uint64_t>(steps), true);
}

}  // namespace

StepOutcomes::StepOutcomes(const ir::Interpreter& interpreter)
    : interpreter_(interpreter),
      scratch_(interpreter.scratch_size()),
      observation_(interpreter.observation_size()),
      next_(interpreter.state_size()) {}

std::uint8_t StepOutcomes::causes_in(const std::byte* state,
                                     rddl::Context<rddl::Scalar>& context) const {
    int causes = interpreter_.terminal(state, context) ? RDDL_TERMINATED : 0;
    if (interpreter_.violates_invariant(state, context)) causes |= RDDL_TRUNCATED_INVARIANT;
    if (context.fault) causes |= RDDL_FAULTED;
    return static_cast<std::uint8_t>(causes);
}

void StepOutcomes::visit(const std::byte* state, const std::byte* action, std::int64_t steps,
                         const std::function<bool(const ListedOutcome&)>& visit) {
    ir::Outcomes outcomes;
    do {
        auto context = context_at(steps + 1);
        const double reward = interpreter_.step(state, action, scratch_.data(), next_.data(),
                                                observation_.data(), context, &outcomes);
        const std::uint8_t causes = causes_in(next_.data(), context);
        if (!visit({next_.data(), outcomes.probability(), reward, causes})) return;
    } while (outcomes.next());
}

void StepOutcomes::visit_starts(const std::function<bool(const ListedOutcome&)>& visit) {
    ir::Outcomes outcomes;
    do {
        auto context = context_at(0);
        interpreter_.reset(next_.data(), context, &outcomes);
        const std::uint8_t causes = causes_in(next_.data(), context);
        if (!visit({next_.data(), outcomes.probability(), 0, causes})) return;
    } while (outcomes.next());
}

bool StepOutcomes::is_legal(const std::byte* state, const std::byte* action) {
    auto context = context_at(1);
    return interpreter_.violated_precondition(state, action, context) < 0;
}

void require_certain_conditions(const ir::Program& program) {
    const std::vector<ir::Properties> known = ir::all_properties(program);
    for (const auto* all : {&program.terminations, &program.invariants, &program.preconditions})
        for (const ir::Computation& condition : *all)
            for (const ir::NodeId root : ir::roots_of(condition))
                if (known[root.index].random)
                    throw Failure(
                        "a termination, an invariant or a precondition draws at random: "
                        "the outcomes of a step cannot be listed");
}

}  // namespace rddlc::workbench
