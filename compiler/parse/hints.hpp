// Guesses at the cause of a syntax error, from what habit of other languages leads to it.
#pragma once

#include "parse/syntax_error.hpp"

namespace rddlc {

// Empty when nothing comes to mind.
Hint hint_for(const SyntaxError& error);

}  // namespace rddlc
