#include "ir/split_quantifier.hpp"

#include "ir/analysis.hpp"
#include "ir/rewrite.hpp"

namespace rddlc::ir {

std::optional<SplitQuantifier> split_quantifier(Builder& builder, const Reduce& reduce) {
    if (!is_quantifier(reduce.op)) return std::nullopt;
    SplitQuantifier split{
        reduce.op == Reduction::Exists ? Operator::And : Operator::Or, {}, reduce};
    std::vector<NodeId> inside;
    for (const NodeId part : parts_of(builder.program(), reduce.body, split.op)) {
        const bool depends = depends_on_any(builder.properties(part), {&reduce.variable, 1});
        (depends ? inside : split.fixed).push_back(part);
    }
    if (inside.empty()) return std::nullopt;
    split.rest.body = joined(builder, split.op, inside);
    return split;
}

}  // namespace rddlc::ir
