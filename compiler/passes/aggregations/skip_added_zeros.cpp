#include "passes/aggregations/skip_added_zeros.hpp"

#include "ir/analysis.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/bool_factor.hpp"

#include <optional>
#include <utility>

namespace rddlc::passes {
namespace {

// The term of an addition as a choice, if constants tell whether it counts: then a pack evaluates
// it for all of its environments or for none.
std::optional<ir::NodeId> chosen_by_constants(ir::Builder& builder, ir::NodeId term) {
    const auto choice = without_bool_factor(builder, term);
    if (!choice || !choice->value) return std::nullopt;
    const ir::Properties& counts = builder.properties(choice->counts);
    const ir::Properties& value = builder.properties(*choice->value);
    if (!counts.uniform || counts.may_fault || value.may_fault || !value.finite ||
        value.cost < worth_a_branch)
        return std::nullopt;
    return builder.select(choice->counts, *choice->value, builder.constant(0.0));
}

// Where the other operand may be -0.0, it matters which zero is added.
std::optional<ir::NodeId> addition_that_skips(ir::Builder& builder, const ir::Apply& addition) {
    const ir::NodeId a = addition.operands.front(), b = addition.operands.back();
    const auto may_be_added_to = [&](ir::NodeId id) {
        return builder.properties(id).never_negative_zero;
    };
    if (may_be_added_to(a))
        if (const auto term = chosen_by_constants(builder, b))
            return builder.apply(Operator::Add, {a, *term});
    if (may_be_added_to(b))
        if (const auto term = chosen_by_constants(builder, a))
            return builder.apply(Operator::Add, {*term, b});
    return std::nullopt;
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
            if (made) ++report["terms computed where constants let them count"];
            return made;
        });
}

}  // namespace rddlc::passes
