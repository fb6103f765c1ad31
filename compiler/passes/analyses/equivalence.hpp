// Expressions that have the same value because operands may change places.
#pragma once

#include "ir/ir.hpp"

namespace rddlc::passes {

// Both have the same value for certain: they differ by the order of operands that commute, by the
// sign of differences that are squared, or by which of several equal values are compared.
bool are_equivalent(const ir::Program& program, ir::NodeId a, ir::NodeId b);

}  // namespace rddlc::passes
