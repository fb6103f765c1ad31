#include "passes/aggregations/factor_quantifiers.hpp"

#include "ir/analysis.hpp"
#include "ir/rewrite.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// Operations (Properties::cost) of a rest that is worth computing once. Packs combine bools of
// tables in fewer.
constexpr double least_cost = 8;

std::optional<ir::NodeId> factored(ir::Builder& builder, ir::NodeId id) {
    const auto* found = std::get_if<ir::Reduce>(&builder.program()[id].form);
    if (!found || (found->op != Reduction::Exists && found->op != Reduction::ForAll) ||
        builder.properties(id).may_fault)
        return std::nullopt;
    ir::Reduce reduce = *found;
    const Operator op = reduce.op == Reduction::Exists ? Operator::And : Operator::Or;
    std::vector<ir::NodeId> inside, outside;
    for (const ir::NodeId part : ir::parts_of(builder.program(), reduce.body, op)) {
        const bool depends = ir::depends_on_any(builder.properties(part), {&reduce.variable, 1});
        (depends ? inside : outside).push_back(part);
    }
    if (inside.empty() || outside.empty()) return std::nullopt;
    reduce.body = ir::joined(builder, op, inside);
    if (builder.properties(reduce.body).cost < least_cost) return std::nullopt;
    outside.push_back(builder.rebuild({ir::Scalar::Bool, reduce}));
    return ir::joined(builder, op, outside);
}

}  // namespace

ir::Program factor_quantifiers(ir::Program program, Report& report) {
    return ir::rewrite(
        std::move(program),
        [&](ir::Builder& builder, ir::NodeId, const ir::Node& node) -> std::optional<ir::NodeId> {
            if (!std::holds_alternative<ir::Reduce>(node.form)) return std::nullopt;
            const auto result = factored(builder, builder.rebuild(node));
            if (result) ++report["quantifiers factored"];
            return result;
        });
}

}  // namespace rddlc::passes
