// Layout of expressions.
#pragma once

#include "ast/ast.hpp"
#include "format/cursor.hpp"

namespace rddlc::format {

// The tokens of `expr` come next. If the text breaks a chain of operators, an if, the body of an
// aggregation or the cases of a switch, the layout also does, even if it fits on one line.
Doc layout_expression(const ast::Expr& expr, Cursor& cursor);

// Whether the lines of a broken layout are indented from the line on which the expression begins,
// because they stand in brackets; otherwise they begin in its column.
bool hugs(const ast::Expr& expr);

}  // namespace rddlc::format
