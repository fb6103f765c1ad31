#include "ground/ground.hpp"

#include "ground/bounds.hpp"
#include "ground/certain_faults.hpp"
#include "ground/codes.hpp"
#include "ground/declare.hpp"
#include "ground/lowering.hpp"
#include "ground/memory.hpp"
#include "ground/most_true.hpp"
#include "ir/analysis.hpp"
#include "ir/builder.hpp"
#include "ir/layout.hpp"
#include "ir/verify.hpp"
#include "model/fingerprint.hpp"

#include <algorithm>
#include <utility>

namespace rddlc {
namespace {

std::vector<ir::Computation> lower_all(const std::vector<model::Expr>& conditions,
                                       grounding::Lowering& lowering) {
    std::vector<ir::Computation> lowered;
    for (const model::Expr& condition : conditions) lowered.push_back(lowering.value_of(condition));
    return lowered;
}

ir::Policy policy_of(const model::Policy& policy, grounding::Lowering& lowering) {
    ir::Policy lowered{policy.name, {}, policy.span};
    for (const model::Cpf& cpf : policy.cpfs) lowered.act.push_back(lowering.definition_of(cpf));
    return lowered;
}

// Conditions and initial values have their tables on the stack.
constexpr std::size_t most_bytes_of_tables = 1 << 20;

void report_large_tables(const ir::Program& program, Diagnostics& diagnostics) {
    if (ir::record_layout(program, ir::Storage::Scratch).size <= most_bytes_of_tables) return;
    for (const ir::Definition& value : program.reset) {
        if (!ir::calls_functions(value.body)) continue;
        diagnostics.report(
            {grounding::not_supported_yet, value.span,
             "valid RDDL, not supported yet: matrix and external functions in initial "
             "values where all tables of a step take more than 1 MB"});
    }
    for (const auto* conditions :
         {&program.preconditions, &program.invariants, &program.terminations}) {
        for (const ir::Computation& condition : *conditions) {
            if (!ir::fills_tables(condition.body)) continue;
            diagnostics.report({grounding::not_supported_yet, condition.span,
                                "valid RDDL, not supported yet: matrix and external functions in "
                                "conditions where all tables of a step take more than 1 MB"});
        }
    }
}

// Reals that no expression reads may be anything, so that a step does not ask for their values.
// This is known only now: passes may leave out the last read of a real because it is moderate.
void forget_ranges_of_unread_reals(ir::Program& program) {
    std::vector<bool> is_read(program.buffers.size(), false);
    for (const ir::Node& node : program.nodes) {
        if (const auto* load = std::get_if<ir::Load>(&node.form))
            is_read[load->buffer.index] = true;
    }
    for (const ir::BufferId id : ir::reals_taken_for_moderate(program))
        if (!is_read[id.index]) program.buffers[id.index].range.reset();
}

std::optional<ir::Program> ground(const model::Model& model, Diagnostics& diagnostics,
                                  std::int64_t memory_limit, bool only_moderate) {
    const std::size_t errors_before = diagnostics.error_count();
    grounding::Declarations declarations = grounding::declare(model, only_moderate);
    ir::Program& program = declarations.program;
    {
        ir::Builder builder(program);
        grounding::Lowering lowering(model, declarations.buffers, program, builder, diagnostics);
        for (const model::Cpf& cpf : model.cpfs)
            program.step.push_back(lowering.definition_of(cpf));
        program.reward = lowering.value_of(model.reward);
        program.preconditions = lower_all(model.action_preconditions, lowering);
        program.invariants = lower_all(model.state_invariants, lowering);
        program.terminations = lower_all(model.terminations, lowering);
        for (const model::InitialDraw& draw : model.initial_draws)
            program.reset.push_back(lowering.definition_of(draw));
        // The policy comes at the end, so that neither sites nor nodes of the simulator change with
        // it.
        if (model.policy) program.policy = policy_of(*model.policy, lowering);
        grounding::find_most_true(builder, program);
        if (diagnostics.error_count() == errors_before)
            grounding::warn_of_certain_faults(builder, diagnostics);
    }
    forget_ranges_of_unread_reals(program);
    report_large_tables(program, diagnostics);
    report_memory(program, memory_limit, diagnostics);
    if (diagnostics.error_count() > errors_before) return std::nullopt;
    grounding::find_bounds(model, declarations.buffers, program, diagnostics);
    if (diagnostics.error_count() > errors_before) return std::nullopt;
#ifndef NDEBUG
    ir::expect_valid(program, "ground");
#endif
    return std::move(program);
}

bool reads_reals(const ir::Program& program) {
    return std::ranges::any_of(program.buffers, [](const ir::Buffer& buffer) {
        return buffer.scalar == ir::Scalar::Real &&
               (buffer.storage == ir::Storage::State || buffer.storage == ir::Storage::Action);
    });
}

}  // namespace

std::optional<ir::Program> ground(const model::Model& model, Diagnostics& diagnostics,
                                  std::int64_t memory_limit) {
    auto program = ground(model, diagnostics, memory_limit, false);
    if (!program) return program;
    program->fingerprint = model::fingerprint(model);
    if (program->policy || !reads_reals(*program)) return program;
    Diagnostics already_reported;
    auto moderate = ground(model, already_reported, memory_limit, true);
    if (moderate) program->moderate = *std::move(moderate);
    return program;
}

}  // namespace rddlc
