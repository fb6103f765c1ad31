// The conditions of an exists or forall that its variable does not change:
//
//     exists[d in rover](near[m, d] && !state.harvested[m])
//
// has `!state.harvested[m]` beside exists[d in rover](near[m, d]), and is the conjunction of both.
// A forall over a disjunction is the disjunction of such parts.
#pragma once

#include "ir/builder.hpp"
#include "ir/ir.hpp"

#include <optional>
#include <vector>

namespace rddlc::ir {

struct SplitQuantifier {
    Operator op;                // that joins the parts
    std::vector<NodeId> fixed;  // may be empty
    Reduce rest;
};

// Nothing for other aggregations, and where all conditions are fixed.
std::optional<SplitQuantifier> split_quantifier(Builder& builder, const Reduce& reduce);

}  // namespace rddlc::ir
