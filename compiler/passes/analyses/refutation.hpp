// Proves that a condition is false for all values of its numbers within bounds.
//
// First by interval arithmetic. Then by contradiction: the condition is taken to be true, which
// narrows the bounds of its operands, down to those of its numbers and up again (HC4, F. Benhamou,
// F. Goualard, L. Granvilliers and J.-F. Puget, Revising hull and box consistency, 1999). Where a
// disjunction is open, each of its parts has to lead to a contradiction.
#pragma once

#include "passes/analyses/line_bounds.hpp"
#include "passes/analyses/object_condition.hpp"

#include <cstdint>
#include <span>

namespace rddlc::passes {

// By interval arithmetic alone. The bounds are those of the condition's numbers.
bool is_false_within(const ObjectCondition& condition, std::int64_t object,
                     std::span<const LineBounds> bounds);
bool is_refuted_within(const ObjectCondition& condition, std::int64_t object,
                       std::span<const LineBounds> bounds);

}  // namespace rddlc::passes
