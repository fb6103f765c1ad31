// Text with choices of where to break lines, and the printer that makes the choices.
//
// The algebra is that of P. Wadler, "A Prettier Printer", in: The Fun of Programming, 2003, in the
// strict form of C. Lindig, "Strictly Pretty", 2000; alignment to the current column is from
// D. Leijen's library PPrint, 2000. Added are alternatives, which are tried in turn, and comments,
// which end their line wherever they stand.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace rddlc::document {

inline constexpr std::size_t page_width = 100;
inline constexpr std::size_t indentation = 4;

struct Document;
using Doc = std::shared_ptr<const Document>;

Doc text(std::string text);
// Separated by commas. Where lines may be broken, as many in each as fit.
Doc words(std::vector<std::string> words);
// A line break in a group that is broken, `flat` in one that is not.
Doc line(std::string flat = " ");
// Nothing in a group that is not broken.
Doc if_broken(std::string text);
Doc concat(std::vector<Doc> parts);
// Lines that begin inside are indented further.
Doc nest(Doc body);
// Lines that begin inside begin where the body begins.
Doc align(Doc body);
// One line if it fits, otherwise each of its own lines is broken; always so if `broken`.
Doc group(Doc body, bool broken = false);
// The same without a choice. A part that cannot be on one line does not fit.
Doc flat(Doc body);
// The first whose first line fits, or else the last.
Doc alternatives(std::vector<Doc> choices);
// A comment behind the text; the next text begins a line. Further lines continue the comment below
// it.
Doc trailing_comment(std::vector<std::string> lines);
// A comment on a line of its own.
Doc own_line_comment(std::string text);

inline constexpr std::size_t unbounded = static_cast<std::size_t>(-1);
// The width on one line; unbounded for what needs several.
std::size_t flat_width(const Doc& doc);

// A line of output. The comment behind it is kept apart: it does not count for the width, and
// comments of lines that follow each other are aligned at the end.
struct TextLine {
    std::string text;
    std::string comment;
};

// Appends the lines of `doc`. `head` is what the first line begins with, its indentation included;
// other lines are indented by `indent`.
void render(const Doc& doc, std::string head, std::size_t indent, std::vector<TextLine>& lines);

}  // namespace rddlc::document
