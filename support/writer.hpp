// Text with indentation, written line by line.
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace rddlc {

class Writer {
  public:
    explicit Writer(int spaces_per_level = 4) : spaces_per_level_(spaces_per_level) {}

    // One line at the current level. An empty text gives an empty line without trailing blanks;
    // line breaks inside the text begin further lines of the same level.
    Writer& line(std::string_view text = {});
    // Text as it stands, without indentation or line break.
    Writer& raw(std::string_view text);

    Writer& indent();
    Writer& dedent();

    // line(opening), body() one level deeper, line(closing).
    template <class Body>
    Writer& block(std::string_view opening, std::string_view closing, Body&& body) {
        line(opening).indent();
        body();
        return dedent().line(closing);
    }

    const std::string& text() const& { return text_; }
    std::string text() && { return std::move(text_); }

  private:
    int spaces_per_level_;
    int level_ = 0;
    std::string text_;
};

}  // namespace rddlc
