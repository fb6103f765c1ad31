// Equality of trees up to spans: did two texts say the same?
#pragma once

#include "ast/ast.hpp"

namespace rddlc::ast {

bool equal(const Program& a, const Program& b);
bool equal(const Expr& a, const Expr& b);

}  // namespace rddlc::ast
