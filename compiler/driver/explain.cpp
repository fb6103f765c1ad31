#include "driver/explain.hpp"

#include <algorithm>

namespace rddlc {

std::optional<std::string_view> explain(Code code) {
    const std::string name = to_string(code);
    const auto found = std::ranges::find(pages, name, &Page::name);
    if (found == pages.end()) return std::nullopt;
    return found->text;
}

}  // namespace rddlc
