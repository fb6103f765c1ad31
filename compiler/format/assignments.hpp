// Layout of the values of an instance: tables, if they are written so.
#pragma once

#include "format/cursor.hpp"

namespace rddlc::format {

// All assignments up to the '}' that ends the section. What stands on one line stays on one line as
// far as the page is wide; lines about the same fluents are aligned. A line that begins below
// another than the first assignment of the line above stays there.
void print_assignments(Cursor& cursor, std::size_t indent, std::vector<TextLine>& lines);

}  // namespace rddlc::format
