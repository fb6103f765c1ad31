// The pages of docs/diagnostics, built into the program.
#pragma once

#include "support/diagnostic.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace rddlc {

struct Page {
    std::string_view name;  // "E0203"
    std::string_view text;  // Markdown
};

// The pages in the order of their names.
extern const std::span<const Page> pages;

std::optional<std::string_view> explain(Code code);

// "E0101: unexpected text" and so on, the titles of the pages.
std::string list_of_codes();

}  // namespace rddlc
