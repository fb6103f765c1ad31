// Layout of the values of an instance: tables, if they are written so.
#pragma once

#include "ast/ast.hpp"
#include "format/cursor.hpp"

#include <vector>

namespace rddlc::format {

// The assignments of a section, whose tokens come next. Assignments on one line stay on one line as
// far as the page is wide; lines about the same fluents are aligned. A line that begins below
// another than the first assignment of the line above stays there.
void print_assignments(const std::vector<ast::Assignment>& assignments, Cursor& cursor,
                       std::size_t indent, std::vector<TextLine>& lines);

}  // namespace rddlc::format
