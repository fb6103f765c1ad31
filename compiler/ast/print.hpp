// The tree as RDDL text. For trees made by the parser, parse(print(tree)) equals the tree:
// brackets are nodes (Group), so the printer never needs to add any.
#pragma once

#include "ast/ast.hpp"

#include <string>

namespace rddlc::ast {

std::string print(const Program& program);

// The expression on one line.
std::string print(const Expr& expr);
// Broken into lines where it is longer than `width`; further lines begin at column 0.
std::string print_wrapped(const Expr& expr, std::size_t width);

}  // namespace rddlc::ast
