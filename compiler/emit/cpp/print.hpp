// Prints the tree (tree.hpp) in lines of at most 100 columns, unless a word is longer.
#pragma once

#include "emit/cpp/tree.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace rddlc::cpp {

inline constexpr std::size_t line_width = 100;
inline constexpr std::size_t indentation = 4;

namespace tree {

// The text of an expression on one line.
std::size_t width(const Expression& expression);

// Definitions at a level of indentation. Those of one line stand together.
std::string print(const Block& definitions, std::size_t level);

}  // namespace tree
}  // namespace rddlc::cpp
