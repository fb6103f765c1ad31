#include "passes/analyses/bool_factor.hpp"

#include "ir/analysis.hpp"

namespace rddlc::passes {

std::optional<BoolFactor> without_bool_factor(ir::Builder& builder, ir::NodeId term) {
    const ir::Program& program = builder.program();
    if (const auto counts = ir::converted_bool(program, term))
        return BoolFactor{*counts, std::nullopt};
    const ir::Node node = program[term];
    if (const auto* convert = std::get_if<ir::Convert>(&node.form)) {
        if (program[convert->operand].type != ir::Scalar::Int) return std::nullopt;
        auto choice = without_bool_factor(builder, convert->operand);
        if (choice && choice->value) choice->value = builder.convert(*choice->value, node.type);
        return choice;
    }
    const auto* product = std::get_if<ir::Apply>(&node.form);
    if (!product || product->op != Operator::Multiply) return std::nullopt;
    const ir::NodeId a = product->operands.front(), b = product->operands.back();
    if (const auto counts = ir::converted_bool(program, a)) return BoolFactor{*counts, b};
    if (const auto counts = ir::converted_bool(program, b)) return BoolFactor{*counts, a};
    for (const bool is_first : {true, false}) {
        const auto choice = without_bool_factor(builder, is_first ? a : b);
        if (!choice) continue;
        if (!choice->value) return BoolFactor{choice->counts, is_first ? b : a};
        return BoolFactor{choice->counts,
                          builder.apply(Operator::Multiply, {is_first ? *choice->value : a,
                                                             is_first ? b : *choice->value})};
    }
    return std::nullopt;
}

}  // namespace rddlc::passes
