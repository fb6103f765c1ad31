#include "support/source.hpp"

#include "support/files.hpp"
#include "support/utf8.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <fstream>

namespace rddlc {

namespace {

// Lines end at "\n", "\r\n" or a lone "\r".
std::vector<std::uint32_t> find_line_begins(std::string_view text) {
    std::vector<std::uint32_t> begins{0};
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool ends_line =
            text[i] == '\n' || (text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n'));
        if (ends_line) begins.push_back(static_cast<std::uint32_t>(i + 1));
    }
    return begins;
}

std::string_view without_line_break(std::string_view line) {
    while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) line.remove_suffix(1);
    return line;
}

std::string on_one_line(std::string_view rddl) {
    std::string result;
    for (std::size_t i = 0; i < rddl.size(); ++i) {
        if (rddl.substr(i, 2) == "//") i = rddl.find('\n', i);
        if (i >= rddl.size()) break;  // the comment ends with the text
        const bool blank = std::string_view(" \t\r\n").find(rddl[i]) != std::string_view::npos;
        if (!blank) {
            result += rddl[i];
        } else if (!result.empty() && result.back() != ' ') {
            result += ' ';
        }
    }
    if (result.ends_with(' ')) result.pop_back();
    return result;
}

}  // namespace

Span cover(Span first, Span last) {
    assert(first.file == last.file);
    return {first.file, std::min(first.begin, last.begin), std::max(first.end, last.end)};
}

Source::Source(std::string path, std::string text)
    : path_(std::move(path)), text_(std::move(text)), line_begins_(find_line_begins(text_)) {}

Position Source::position(std::uint32_t offset) const {
    offset = std::min(offset, static_cast<std::uint32_t>(text_.size()));
    const auto after = std::upper_bound(line_begins_.begin(), line_begins_.end(), offset);
    const std::uint32_t begin = *(after - 1);
    const std::string_view before = std::string_view(text_).substr(begin, offset - begin);
    const auto column = std::count_if(before.begin(), before.end(), begins_character);
    return {static_cast<int>(after - line_begins_.begin()), static_cast<int>(column) + 1};
}

std::uint32_t Source::line_begin(int number) const {
    return line_begins_[static_cast<std::size_t>(number - 1)];
}

std::string_view Source::line(int number) const {
    const auto index = static_cast<std::size_t>(number);
    const std::size_t begin = line_begin(number);
    const std::size_t end = index < line_begins_.size() ? line_begins_[index] : text_.size();
    return without_line_break(std::string_view(text_).substr(begin, end - begin));
}

FileId Sources::add(std::string path, std::string text) {
    files_.emplace_back(std::move(path), std::move(text));
    return static_cast<FileId>(files_.size() - 1);
}

std::optional<FileId> Sources::load(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    if (!stream) return std::nullopt;
    std::string text;
    std::array<char, 1 << 16> block;
    while (text.size() <= largest_text &&
           (stream.read(block.data(), block.size()) || stream.gcount() > 0))
        text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
    // A folder opens but cannot be read.
    if (stream.bad()) {
        std::error_code ignored;
        errno = std::filesystem::is_directory(path, ignored) ? EISDIR : EIO;
        return std::nullopt;
    }
    if (text.size() > largest_text) {
        errno = EFBIG;
        return std::nullopt;
    }
    return add(path.string(), std::move(text));
}

std::string_view Sources::text(Span span) const {
    return std::string_view(files_[span.file].text()).substr(span.begin, span.end - span.begin);
}

std::string Sources::text_on_one_line(Span span) const {
    return on_one_line(text(span));
}

std::string Sources::location(Span span) const {
    const Position at = position(span);
    return fmt::format("{}:{}:{}", files_[span.file].path(), at.line, at.column);
}

}  // namespace rddlc
