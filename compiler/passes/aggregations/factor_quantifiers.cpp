#include "passes/aggregations/factor_quantifiers.hpp"

#include "ir/rewrite.hpp"
#include "ir/split_quantifier.hpp"

#include <optional>
#include <utility>

namespace rddlc::passes {
namespace {

// Operations (Properties::cost) of a rest that is worth computing once. Packs combine bools of
// tables in fewer.
constexpr double least_cost = 8;

std::optional<ir::NodeId> factored(ir::Builder& builder, ir::NodeId id) {
    const auto* found = std::get_if<ir::Reduce>(&builder.program()[id].form);
    if (!found || builder.properties(id).may_fault) return std::nullopt;
    auto split = ir::split_quantifier(builder, ir::Reduce(*found));
    if (!split || split->fixed.empty() || builder.properties(split->rest.body).cost < least_cost)
        return std::nullopt;
    split->fixed.push_back(builder.rebuild({ir::Scalar::Bool, split->rest}));
    return ir::joined(builder, split->op, split->fixed);
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
