// Guesses at the cause of a syntax error, from what habit of other languages leads to it.
#pragma once

#include "parse/syntax_error.hpp"

#include <string>

namespace rddlc {

// A whole clause; empty when nothing comes to mind.
std::string hint_for(const SyntaxError& error);

}  // namespace rddlc
