// Messages about an unknown name.
#pragma once

#include "check/scope.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace rddlc::checking {

// Reports it with the likely cause: a misspelling, "a-b" without blanks, a function with round
// brackets.
// `whole` is the place of the name with its arguments.
void report_unknown_name(const ast::Reference& reference, Span whole, Scope& scope);

// A hint for "True" and the like; else empty.
Hint hint_for_bool(std::string_view name, Span place);

// The name that is meant, else a list of all. Empty if there are no names.
Hint suggestion_or_list(const Context& context, std::string_view name, Span place,
                        const std::vector<std::string>& names);

// The literals a domain may use, without "@".
std::vector<std::string> enumerated_members(const Context& context);

// The names with "@".
std::vector<std::string> as_literals(std::vector<std::string> names);

}  // namespace rddlc::checking
