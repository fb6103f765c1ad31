// Sets of tokens in the user's words.
#pragma once

#include "parse/syntax_error.hpp"

#include <string>

namespace rddlc {

// "')' or an operator", "an expression", "';'"
std::string describe_expected(const SyntaxError& error);
// "'foo'", "the end of the file"
std::string describe_found(const Token& token);

bool is_reserved_word(const Token& token);

}  // namespace rddlc
