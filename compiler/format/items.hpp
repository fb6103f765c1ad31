// Declarations below each other, in columns.
#pragma once

#include "format/cursor.hpp"

#include <string>
#include <vector>

namespace rddlc::format {

// A declaration. Neighbours without a blank line or a comment between them form a paragraph, if
// they have cells; in a paragraph, the n-th cells of all items are equally wide.
struct Item {
    Lead lead;
    std::vector<std::string> cells;
    Doc rest;
};

void print_lead(const Lead& lead, std::size_t indent, std::vector<TextLine>& lines);
void print_items(const std::vector<Item>& items, std::size_t indent, std::vector<TextLine>& lines);

// The text of a file: comments behind lines that follow each other begin in one column, and blank
// lines stand neither at the ends nor twice in a row.
std::string join(const std::vector<TextLine>& lines);

}  // namespace rddlc::format
