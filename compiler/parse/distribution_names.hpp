// Distributions that pyRDDLGym does not have. Their names are not reserved, as they would be if the
// lexer knew them: a problem of pyRDDLGym may have a fluent, a type or an object of such a name.
#pragma once

#include "parse/tokens.hpp"

#include <functional>
#include <string_view>

namespace rddlc {

using TokenList = std::vector<std::unique_ptr<Token>>;

// Makes a distribution of each such name before '(' in a domain, unless the text declares a fluent
// of that name. Elsewhere it stays a name: the declarations of a policy's fluents are in another
// file.
void mark_distributions(const TokenList& tokens,
                        const std::function<bool(std::string_view)>& is_distribution);

// Distributions that only --std=rddlc has.
bool is_distribution_of_ours(std::string_view name);

}  // namespace rddlc
