// Finds the parts of an expression that decide on their own that it has a given value.
//
//     c == d && state.up[d]                 is false unless c == d, and unless state.up[d]
//     c != d || state.up[d]                 is true unless c == d, and unless !state.up[d]
//     real(c == d) * COST[d]                is 0 unless c == d (if COST is finite)
#pragma once

#include "ir/builder.hpp"
#include "ir/ir.hpp"

#include <vector>

namespace rddlc::passes {

// A bool that must have this value; or else the whole expression has the value asked about.
struct Condition {
    ir::NodeId id;
    bool needed;
    auto operator<=>(const Condition&) const = default;
};

// The expression has `value` unless all of these hold. Only parts that it evaluates in any case
// count. A zero may have either sign, which a sum does not show: it begins with 0.0.
std::vector<Condition> decisive_conditions(const ir::Builder& builder, ir::NodeId id,
                                           const ir::Value& value);

}  // namespace rddlc::passes
