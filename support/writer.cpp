#include "support/writer.hpp"

#include <cassert>

namespace rddlc {

Writer& Writer::line(std::string_view text) {
    while (true) {
        const std::size_t end = text.find('\n');
        const std::string_view first = text.substr(0, end);
        if (!first.empty()) text_.append(static_cast<std::size_t>(level_ * spaces_per_level_), ' ');
        text_.append(first).push_back('\n');
        if (end == std::string_view::npos) return *this;
        text.remove_prefix(end + 1);
    }
}

Writer& Writer::raw(std::string_view text) {
    text_.append(text);
    return *this;
}

Writer& Writer::indent() {
    ++level_;
    return *this;
}

Writer& Writer::dedent() {
    assert(level_ > 0);
    --level_;
    return *this;
}

}  // namespace rddlc
