#include "passes/aggregations/keep_bools.hpp"

#include "ir/analysis.hpp"
#include "ir/rewrite.hpp"

#include <optional>
#include <utility>

namespace rddlc::passes {
namespace {

std::optional<ir::NodeId> kept(ir::Builder& builder, const ir::Apply& apply) {
    if (apply.op != Operator::Multiply) return std::nullopt;
    const ir::NodeId a = apply.operands.front(), b = apply.operands.back();
    const auto first = ir::converted_bool(builder.program(), a),
               second = ir::converted_bool(builder.program(), b);
    // The right operand of a connective must not fault.
    if (!first || !second || !ir::is_droppable(builder.properties(*second))) return std::nullopt;
    const ir::Scalar type = builder.program()[a].type;
    const ir::NodeId hold = builder.apply(Operator::And, {*first, *second});
    return builder.convert(hold, type);
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
