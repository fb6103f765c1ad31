// How tightly operators bind.
#pragma once

#include "ast/ast.hpp"

namespace rddlc::ast {

// Larger binds tighter. Operators of one precedence are grouped from the left.
int precedence(BinaryOperator op);

}  // namespace rddlc::ast
