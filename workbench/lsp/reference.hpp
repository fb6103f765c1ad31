// The meaning of RDDL's own words, from the vocabulary and from pages of docs/, which are built in.
#pragma once

#include "support/diagnostic.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace rddlc::lsp {

namespace pages {
extern const std::string_view semantics, distributions;
}

// The text in Markdown; empty for other words.
std::string explanation_of(std::string_view word);

// The page of docs/diagnostics without its example, in Markdown.
std::string explanation_of(Code code);

// The rule of docs/semantics.md with that number, such as "3.5".
std::string_view rule(std::string_view number);

// A block of code in Markdown.
std::string in_code(std::string_view rddl);

// Keywords with an explanation.
std::vector<std::string_view> explained_keywords();

}  // namespace rddlc::lsp
