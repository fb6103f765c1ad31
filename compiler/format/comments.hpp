// The words of a file, each with the comments that belong to it.
//
// The parser skips comments. Here the text is read again, after it has been parsed: it has no
// errors, so it consists of words, numbers and marks only.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::format {

// A comment on a line of its own, "//" included, blanks at its end not.
struct CommentAbove {
    std::string_view text;
    bool blank_line_before;
};

struct Token {
    std::string_view text;  // empty at the end of the file
    std::vector<CommentAbove> above;
    // A comment on the same line, and those below that continue it: they begin in its column.
    std::vector<std::string_view> behind;
    std::uint32_t line_breaks = 0;  // from the token or comment before it
    std::uint32_t column = 0;       // 0-based

    bool begins_line() const { return line_breaks > 0 || !above.empty(); }
    bool has_blank_line_before() const { return line_breaks > 1; }
};

// The last token is the end of the file. The tokens point into `text`.
std::vector<Token> tokens_with_comments(std::string_view text);

}  // namespace rddlc::format
