// The limits that later stages set to a text: they recurse on trees, on ordinary stacks.
#pragma once

#include "support/diagnostic.hpp"
#include "support/source.hpp"

#include <cstddef>

namespace rddlc {

// Brackets inside brackets.
inline constexpr std::size_t max_nesting = 256;
// Depth of an expression's tree: brackets, prefixes and operators on one path to a leaf. A sum of
// n terms is n deep. At this depth parsing, printing and comparing take 1 MB of stack, and 4 MB
// without optimisation under the address sanitizer.
inline constexpr std::size_t max_depth = 1000;
// Words, numbers and marks in one file.
inline constexpr std::size_t max_tokens = 2'000'000;
inline constexpr std::size_t max_bytes = 64 << 20;

// Measures the raw text, before anything recurses on it; reports the first limit that is exceeded.
bool within_limits(FileId file, const Source& source, Diagnostics& diagnostics);

}  // namespace rddlc
