// Words of RDDL.
#pragma once

#include <string_view>

namespace rddlc::lsp {

// A letter first, then also digits, '-' and '_', a letter or digit last; reserved words are also
// names.
bool is_name(std::string_view word);
// Of RDDL's grammar: no fluent, type or object may be called so.
bool is_reserved(std::string_view word);

}  // namespace rddlc::lsp
