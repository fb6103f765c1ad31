// Breaking text that is longer than a line, the way clang-format does it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::cpp {

inline constexpr std::size_t line_width = 100;
inline constexpr int indentation = 4;

// "a, b, c" in as few lines as possible, each beginning at column `column` (the first one already
// stands there) and ending before the line width less `reserve` on the last line.
std::vector<std::string> fill(const std::vector<std::string>& pieces, std::size_t column,
                              std::size_t reserve);

// `lead` and the chain `text` of operands joined by operators, broken after the operators that are
// outside of all brackets; `is_operator` tells which. Without indentation of the whole, which is
// `column`. The continuation lines stand under the first operand, or behind a break after "=".
std::vector<std::string> fill_chain(const std::string& lead, const std::string& text,
                                    const std::vector<std::string_view>& operators,
                                    std::size_t column);

// A call with too many arguments for one line: they stand under each other where they have to, or
// behind a break after the bracket. The call begins at `begin` in `text`.
std::vector<std::string> fill_call(const std::string& text, std::size_t begin, std::size_t column);

// "static void f(" + parameters + ") {" with the parameters under each other where they have to.
std::vector<std::string> fill_call(const std::string& head,
                                   const std::vector<std::string>& arguments,
                                   const std::string& tail, std::size_t column);

}  // namespace rddlc::cpp
