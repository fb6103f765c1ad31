// The value of an operator on constants, by the runtime's own functions; and exact identities.
#pragma once

#include "ir/ir.hpp"

#include <optional>
#include <span>

namespace rddlc::ir {

// How many elements of a sorted table are at most this value; 0 for nan.
std::int64_t count_at_most(const Table& sorted, const Value& value);

Value convert(const Value& value, Scalar type);

// A constant as a step computes with it: a step of floats rounds it to one.
Value as_in_a_step(const Value& value, RealType real);

// Nothing if it faults.
std::optional<Value> fold(Operator op, std::span<const Value> operands);

// The reduction of a body that is the same for all of `size` > 0 objects.
std::optional<Value> fold(Reduction op, std::int64_t size, const Value& body);

// The value over no objects; nothing for reductions that have no value there.
std::optional<Value> fold_empty(Reduction op, Scalar type);

}  // namespace rddlc::ir
