// Source text: files, spans into them, and line/column positions.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc {

using FileId = std::uint32_t;

// A half-open range of bytes [begin, end) of one file.
struct Span {
    FileId file = 0;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;

    bool operator==(const Span&) const = default;
};

// The smallest span that covers both; they must be of the same file.
Span cover(Span first, Span last);

// Where text can be inserted before or behind a span.
inline Span point_before(Span span) {
    return {span.file, span.begin, span.begin};
}
inline Span point_behind(Span span) {
    return {span.file, span.end, span.end};
}
// Of a span that is not empty.
inline Span last_character(Span span) {
    return {span.file, span.end - 1, span.end};
}

// 1-based; columns count UTF-8 code points, as editors do.
struct Position {
    int line = 1;
    int column = 1;
};

class Source {
  public:
    Source(std::string path, std::string text);

    const std::string& path() const { return path_; }
    const std::string& text() const { return text_; }

    Position position(std::uint32_t offset) const;
    // The text of a 1-based line without its line break.
    std::string_view line(int number) const;
    // The byte offset at which a 1-based line begins.
    std::uint32_t line_begin(int number) const;

  private:
    std::string path_;
    std::string text_;
    std::vector<std::uint32_t> line_begins_;
};

// All files of one compilation. References stay valid as files are added.
class Sources {
  public:
    FileId add(std::string path, std::string text);
    // Reads a file; nothing if it cannot be read (the caller reports it with strerror(errno)).
    std::optional<FileId> load(const std::filesystem::path& path);

    const Source& operator[](FileId file) const { return files_[file]; }
    std::size_t size() const { return files_.size(); }

    Position position(Span span) const { return files_[span.file].position(span.begin); }
    std::string_view text(Span span) const;
    // The text without its comments and line breaks; blanks are single.
    std::string text_on_one_line(Span span) const;
    // "path:line:column", as compilers print it.
    std::string location(Span span) const;

  private:
    std::deque<Source> files_;
};

}  // namespace rddlc
