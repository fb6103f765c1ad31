#include "passes/aggregations/factor_quantifiers.hpp"

#include "ir/rewrite.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// Operations (Properties::cost) of a rest that is worth computing once. Packs combine bools of
// tables in fewer.
constexpr double least_cost = 8;

using Parts = std::vector<ir::NodeId>;

// The parts of a conjunction, or of a disjunction.
void collect_parts(const ir::Program& program, Operator op, ir::NodeId id, Parts& parts) {
    const auto* apply = std::get_if<ir::Apply>(&program[id].form);
    if (!apply || apply->op != op) return parts.push_back(id);
    for (const ir::NodeId operand : apply->operands) collect_parts(program, op, operand, parts);
}

ir::NodeId joined(ir::Builder& builder, Operator op, const Parts& parts) {
    ir::NodeId result = parts.front();
    for (std::size_t k = 1; k < parts.size(); ++k) result = builder.apply(op, {result, parts[k]});
    return result;
}

std::optional<ir::NodeId> factored(ir::Builder& builder, ir::NodeId id) {
    const auto* found = std::get_if<ir::Reduce>(&builder.program()[id].form);
    if (!found || (found->op != Reduction::Exists && found->op != Reduction::ForAll) ||
        builder.properties(id).may_fault)
        return std::nullopt;
    ir::Reduce reduce = *found;
    const Operator op = reduce.op == Reduction::Exists ? Operator::And : Operator::Or;
    Parts parts;
    collect_parts(builder.program(), op, reduce.body, parts);
    const auto outside = std::stable_partition(parts.begin(), parts.end(), [&](ir::NodeId part) {
        return !std::ranges::binary_search(builder.properties(part).free_variables,
                                           reduce.variable);
    });
    const Parts rest(outside, parts.end());
    parts.erase(outside, parts.end());
    if (rest.empty() || parts.empty()) return std::nullopt;
    reduce.body = joined(builder, op, rest);
    if (builder.properties(reduce.body).cost < least_cost) return std::nullopt;
    parts.push_back(builder.rebuild({ir::Scalar::Bool, reduce}));
    return joined(builder, op, parts);
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
