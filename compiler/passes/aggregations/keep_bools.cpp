#include "passes/aggregations/keep_bools.hpp"

#include "ir/rewrite.hpp"

#include <optional>
#include <utility>

namespace rddlc::passes {
namespace {

// The bool that became this number.
std::optional<ir::NodeId> bool_of(const ir::Program& program, ir::NodeId number) {
    const auto* form = std::get_if<ir::Convert>(&program[number].form);
    if (!form || program[form->operand].type != ir::Scalar::Bool) return std::nullopt;
    return form->operand;
}

std::optional<ir::NodeId> product(ir::Builder& builder, ir::NodeId a, ir::NodeId b) {
    const auto first = bool_of(builder.program(), a), second = bool_of(builder.program(), b);
    // The right operand of a connective must not fault.
    if (!first || !second || !ir::is_droppable(builder.properties(*second))) return std::nullopt;
    const ir::Scalar type = builder.program()[a].type;
    const ir::NodeId hold = builder.apply(Operator::And, {*first, *second});
    return builder.convert(hold, type);
}

std::optional<ir::NodeId> comparison(ir::Builder& builder, Operator op, ir::NodeId number,
                                     ir::NodeId constant) {
    const auto condition = bool_of(builder.program(), number);
    if (!condition || !std::holds_alternative<ir::Constant>(builder.program()[constant].form))
        return std::nullopt;
    const ir::Scalar type = builder.program()[number].type;
    const auto value_of = [&](bool value) {
        const ir::NodeId converted = builder.convert(builder.constant(value), type);
        return ir::constant<bool>(builder.program(), builder.apply(op, {converted, constant}));
    };
    const auto if_true = value_of(true), if_false = value_of(false);
    if (!if_true || !if_false || *if_true == *if_false) return std::nullopt;
    return *if_true ? *condition : builder.apply(Operator::Not, {*condition});
}

std::optional<ir::NodeId> kept(ir::Builder& builder, const ir::Apply& apply) {
    if (apply.operands.size() != 2) return std::nullopt;
    const ir::NodeId a = apply.operands.front(), b = apply.operands.back();
    if (apply.op == Operator::Multiply) return product(builder, a, b);
    if (is_one_of(apply.op, {Operator::Equal, Operator::NotEqual, Operator::Less,
                             Operator::LessEqual, Operator::Greater, Operator::GreaterEqual}))
        return comparison(builder, apply.op, a, b);
    return std::nullopt;
}

}  // namespace

ir::Program keep_bools(ir::Program program, Report& report) {
    return ir::rewrite(
        std::move(program),
        [&](ir::Builder& builder, ir::NodeId, const ir::Node& node) -> std::optional<ir::NodeId> {
            const auto* apply = std::get_if<ir::Apply>(&node.form);
            const auto result = apply ? kept(builder, *apply) : std::nullopt;
            if (result) ++report["numbers that are bools again"];
            return result;
        });
}

}  // namespace rddlc::passes
