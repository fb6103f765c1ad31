// Characters that are invisible, or that look like others.
#pragma once

#include "support/diagnostic.hpp"

#include <string>
#include <string_view>

namespace rddlc {

// How messages speak of characters that mean nothing: in quotes, or by name if any is invisible.
std::string spoken(std::string_view characters);

// A hint about the first of them that is invisible or looks like one of RDDL; else empty.
// The change is of the whole `place` of the characters.
Hint hint_for_lookalike(std::string_view characters, Span place);

}  // namespace rddlc
