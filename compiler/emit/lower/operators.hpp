// How operators, aggregations and distributions are called in C++.
#pragma once

#include "emit/cpp/tree.hpp"
#include "ir/ir.hpp"
#include "vocabulary/vocabulary.hpp"

#include <string>
#include <variant>

namespace rddlc::cpp {

// An operator of C++, or the function of the runtime in the namespace rddl.
std::variant<tree::Operator, std::string> spelling_of(Operator op, bool on_ints);
// Operators of indices, which cannot overflow.
tree::Operator plain_operator(Operator op);

std::string function_of(Reduction reduction);
std::string function_of(Distribution distribution);  // in rddl::sample
// Qualified: "rddl::cholesky", "rddl_extern::inflow".
std::string function_of(const ir::Program& program, const ir::Callee& callee);

}  // namespace rddlc::cpp
