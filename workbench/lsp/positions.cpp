#include "lsp/positions.hpp"

#include "support/utf8.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace rddlc::lsp {

namespace {

// Characters beyond the first 65,536 have two units in UTF-16, and four bytes in UTF-8.
std::uint32_t utf16_units(char first_byte) {
    if (!begins_character(first_byte)) return 0;
    return static_cast<unsigned char>(first_byte) >= 0xF0 ? 2 : 1;
}

bool is_unreserved(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("-._~/").find(c) != std::string_view::npos;
}

}  // namespace

Text::Text(std::string text) : text_(std::move(text)), line_begins_{0} {
    for (std::size_t i = 0; i < text_.size(); ++i) {
        const bool is_first_of_two =
            text_[i] == '\r' && i + 1 < text_.size() && text_[i + 1] == '\n';
        if (text_[i] == '\n' || (text_[i] == '\r' && !is_first_of_two))
            line_begins_.push_back(static_cast<std::uint32_t>(i + 1));
    }
}

std::string_view Text::of(Place place) const {
    return std::string_view(text_).substr(place.begin, place.end - place.begin);
}

Json Text::position(std::uint32_t offset) const {
    offset = std::min(offset, static_cast<std::uint32_t>(text_.size()));
    const auto after = std::upper_bound(line_begins_.begin(), line_begins_.end(), offset);
    std::uint32_t units = 0;
    for (std::uint32_t i = *(after - 1); i < offset; ++i) units += utf16_units(text_[i]);
    return {{"line", after - line_begins_.begin() - 1}, {"character", units}};
}

Json Text::range(Place place) const {
    return {{"start", position(place.begin)}, {"end", position(place.end)}};
}

std::uint32_t Text::offset(const Json& position) const {
    const std::uint64_t line = position.at("line").get<std::uint64_t>();
    const std::uint64_t wanted = position.at("character").get<std::uint64_t>();
    if (line >= line_begins_.size()) return static_cast<std::uint32_t>(text_.size());
    std::uint32_t offset = line_begins_[line];
    const std::size_t break_at = std::min(text_.find_first_of("\r\n", offset), text_.size());
    for (std::uint64_t units = 0; offset < break_at; ++offset) {
        if (units >= wanted && begins_character(text_[offset])) break;
        units += utf16_units(text_[offset]);
    }
    return offset;
}

Place Text::place(const Json& range) const {
    const std::uint32_t begin = offset(range.at("start"));
    return {begin, std::max(begin, offset(range.at("end")))};
}

std::optional<std::filesystem::path> path_of(std::string_view uri) {
    constexpr std::string_view scheme = "file://";
    if (!uri.starts_with(scheme)) return std::nullopt;
    uri.remove_prefix(scheme.size());
    uri.remove_prefix(std::min(uri.find('/'), uri.size()));  // the host
    std::string path;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        int code = 0;
        const char* const digits = uri.data() + i + 1;
        const bool is_escape = uri[i] == '%' && i + 2 < uri.size() &&
                               std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2;
        path += is_escape ? static_cast<char>(code) : uri[i];
        if (is_escape) i += 2;
    }
    if (path.empty() || path.find('\0') != std::string::npos) return std::nullopt;
    return std::filesystem::path(path).lexically_normal();
}

std::string uri_of(const std::filesystem::path& path) {
    std::string uri = "file://";
    for (const char c : path.string())
        uri += is_unreserved(c) ? std::string(1, c)
                                : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    return uri;
}

}  // namespace rddlc::lsp
