#include "driver/explain.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rddlc {

std::optional<std::string_view> explain(Code code) {
    const std::string name = to_string(code);
    const auto found = std::ranges::find(pages, name, &Page::name);
    if (found == pages.end()) return std::nullopt;
    return found->text;
}

std::string list_of_codes() {
    std::string list;
    for (const Page& page : pages)
        list += fmt::format("{}\n", page.text.substr(2, page.text.find('\n') - 2));
    return list;
}

}  // namespace rddlc
