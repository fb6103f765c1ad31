// Exact algebraic identities of operators and selects. Used by the builder alone.
#pragma once

#include "ir/builder.hpp"

#include <optional>
#include <span>

namespace rddlc::ir {

// The simpler equal of an operator on these operands, if one is known.
//
//     x + 0, x - 0, x * 1, x / 1             x; x + 0.0 only if x is never -0.0
//     (0.0 + x) + y, (0.0 + x) - y           0.0 + (x + y), 0.0 + (x - y)
//     y - (0.0 + x)                          y - x, if y is never -0.0
//     max[y, 0.0 + x]                        max[y, x], if y is at least 0 and never -0.0
//     abs(0.0 + x), 0.0 + x < y, ...         abs(x), x < y, ...: the sign of a zero does not matter
//     -(-x), !(!x)                           x
//     true && x, false || x                  x
//     false && x, true || x                  the constant, unless x draws or may fault
//     !(a == b), !(a < b) on ints            a != b, a >= b
//     a => b                                 !a || b, where neither is constant
//     x == x, x <=> x (not on reals)         true, unless x draws or may fault
//     min[x, x], x && x                      x
//     x || (x && y), x && (x || y)           x, in short chains, unless y draws or may fault
std::optional<NodeId> simplify(Builder& builder, Operator op, std::span<const NodeId> operands);

// x of 0.0 + x; any other node is itself. The same number, except for the sign of a zero.
NodeId without_zero(const Program& program, NodeId id);

//     select(true, a, b)                     a
//     select(c, a, a)                        a, unless c draws or may fault
//     select(c, true, false)                 c
//     select(c, false, true)                 !c
//     select(!c, a, b)                       select(c, b, a)
std::optional<NodeId> simplify_select(Builder& builder, NodeId condition, NodeId then_value,
                                      NodeId else_value);

}  // namespace rddlc::ir
