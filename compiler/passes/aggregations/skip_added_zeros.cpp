#include "passes/aggregations/skip_added_zeros.hpp"

#include "ir/analysis.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/bool_factor.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

namespace rddlc::passes {
namespace {

bool depends_on_all(const ir::Properties& value, std::span<const ir::VariableId> variables) {
    return std::ranges::all_of(
        variables, [&](ir::VariableId variable) { return ir::depends_on(value, variable); });
}

// A loop that the condition needs computes the value once, before it.
bool is_same_in_a_loop(const ir::Node& node, const ir::Properties& value,
                       const ir::Properties& counts) {
    return std::holds_alternative<ir::Apply>(node.form) && !value.random &&
           !depends_on_all(value, counts.free_variables);
}

// The term of an addition as a choice, if constants tell whether it counts: then a pack evaluates
// it for all of its environments or for none. Or if the loop chooses among fewer values.
std::optional<ir::NodeId> chosen(ir::Builder& builder, ir::NodeId term) {
    const auto choice = without_bool_factor(builder, term);
    if (!choice || !choice->value) return std::nullopt;
    const ir::Properties& counts = builder.properties(choice->counts);
    const ir::Properties& value = builder.properties(*choice->value);
    if (counts.may_fault || value.may_fault || !value.finite) return std::nullopt;
    const bool is_by_constants = counts.uniform && value.cost >= worth_a_branch;
    if (!is_by_constants && !is_same_in_a_loop(builder.program()[*choice->value], value, counts))
        return std::nullopt;
    return builder.select(choice->counts, *choice->value, builder.constant(0.0));
}

// The same terms, added in the same order, where it does not matter which zero the sum is.
std::optional<ir::NodeId> with_any_zero(ir::Builder& builder, ir::NodeId id) {
    const ir::Node node = builder.program()[id];
    const auto* addition = std::get_if<ir::Apply>(&node.form);
    if (!addition || addition->op != Operator::Add) return chosen(builder, id);
    const ir::NodeId a = addition->operands.front(), b = addition->operands.back();
    const auto first = with_any_zero(builder, a), second = with_any_zero(builder, b);
    if (!first && !second) return std::nullopt;
    return builder.apply(Operator::Add, {first.value_or(a), second.value_or(b)});
}

// Where the other operand may be -0.0, it matters which zero is added. What one operand becomes may
// show that it is not -0.0, so the first one has a second turn.
std::optional<ir::NodeId> addition_that_skips(ir::Builder& builder, const ir::Apply& addition) {
    std::array operands = {addition.operands.front(), addition.operands.back()};
    bool has_changed = false;
    for (const std::size_t other : {0U, 1U, 0U}) {
        if (!builder.properties(operands[other]).never_negative_zero) continue;
        ir::NodeId& operand = operands[1 - other];
        if (const auto made = with_any_zero(builder, operand)) {
            operand = *made;
            has_changed = true;
        }
    }
    if (!has_changed) return std::nullopt;
    return builder.apply(Operator::Add, {operands[0], operands[1]});
}

}  // namespace

ir::Program skip_added_zeros(ir::Program program, Report& report) {
    return ir::rewrite(
        std::move(program),
        [&](ir::Builder& builder, ir::NodeId, const ir::Node& node) -> std::optional<ir::NodeId> {
            const auto* addition = std::get_if<ir::Apply>(&node.form);
            if (!addition || addition->op != Operator::Add || node.type != ir::Scalar::Real)
                return std::nullopt;
            const auto made = addition_that_skips(builder, *addition);
            if (made) ++report["terms that are chosen where they count"];
            return made;
        });
}

}  // namespace rddlc::passes
