// How operators, aggregations and distributions are called in the runtime.
#pragma once

#include "emit/expressions.hpp"
#include "vocabulary/vocabulary.hpp"

#include <string>

namespace rddlc::cpp {

struct OperatorSpelling {
    std::string word;  // the C++ operator, or the function in namespace rddl
    bool is_infix;     // a C++ operator; the rest is for these
    Level level;
    Level left, right;  // operands that are looser need parentheses
    bool associative;   // but not those of the same level
};
OperatorSpelling spelling_of(Operator op, bool on_ints);

std::string function_of(Reduction reduction);
std::string function_of(Distribution distribution);  // in rddl::sample
// Qualified: "rddl::cholesky", "rddl_extern::inflow".
std::string function_of(const ir::Program& program, const ir::Callee& callee);

}  // namespace rddlc::cpp
