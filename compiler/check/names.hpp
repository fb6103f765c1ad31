// What to say about a name that means nothing.
#pragma once

#include "check/scope.hpp"

#include <string>
#include <vector>

namespace rddlc::checking {

// With the likely cause: a misspelling, "a-b" without blanks, a function with round brackets.
void report_unknown_name(const ast::Reference& reference, Scope& scope);

// The literals a domain may use, without "@".
std::vector<std::string> enumerated_members(const Context& context);

// With "@".
std::vector<std::string> as_literals(std::vector<std::string> names);

}  // namespace rddlc::checking
