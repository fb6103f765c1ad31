// Values and texts as C++ writes them.
#pragma once

#include "emit/emit.hpp"
#include "ir/ir.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace rddlc::cpp {

// Reads back as exactly the same value: true, 42, 0.1, -2.0, 1e+300. Floats are the nearest ones:
// 0.1f, -2.0f.
std::string literal(const ir::Value& value, RealType real = RealType::Double);

// The spelling of an element of a table: bools are 0 and 1, reals drop ".0".
std::string table_entry(const ir::Value& value, RealType real = RealType::Double);

// A string literal, with its double quotes.
std::string literal(std::string_view text);

// Safe after "//": one line, no control characters, no line continuation.
std::string comment_text(std::string_view text);

}  // namespace rddlc::cpp
