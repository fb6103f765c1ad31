#include "formats/table.hpp"

#include "support/utf8.hpp"

#include <algorithm>
#include <sstream>

namespace rddlc::workbench {

namespace {

void trim_trailing_blanks(std::string& text) {
    text.erase(text.find_last_not_of(' ') + 1);
}

}  // namespace

void TextTable::add_row(std::vector<std::string> cells) {
    cells.resize(columns_.size());
    for (std::string& cell : cells) cell = printable_line(cell);
    rows_.push_back(std::move(cells));
}

std::string TextTable::text(std::size_t indent) const {
    std::vector<std::string> titles;
    for (const Column& column : columns_) titles.push_back(column.title);
    std::vector<std::size_t> widths(columns_.size(), 0);
    const auto widen = [&](const std::vector<std::string>& cells) {
        for (std::size_t i = 0; i < cells.size(); ++i)
            widths[i] = std::max(widths[i], display_width(cells[i]));
    };
    widen(titles);
    for (const auto& row : rows_) widen(row);

    std::string out;
    const auto print = [&](const std::vector<std::string>& cells) {
        std::string line(indent, ' ');
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const std::string padding(widths[i] - display_width(cells[i]), ' ');
            if (i > 0) line += "  ";
            line += columns_[i].align == Align::Right ? padding + cells[i] : cells[i] + padding;
        }
        trim_trailing_blanks(line);
        out += line + '\n';
    };
    const bool titled = std::any_of(titles.begin(), titles.end(),
                                    [](const std::string& title) { return !title.empty(); });
    if (titled) print(titles);
    for (const auto& row : rows_) print(row);
    return out;
}

std::string shortened(std::string_view text, std::size_t width) {
    if (display_width(text) <= width) return std::string(text);
    std::string out;
    std::size_t left = width - 1;
    while (true) {
        const Character character = first_character(text);
        if (character.width > left) return out + "…";
        left -= character.width;
        out += character.bytes;
        text.remove_prefix(character.bytes.size());
    }
}

std::vector<std::string> wrapped(std::string_view text, std::size_t width) {
    std::istringstream words{std::string(text)};
    std::vector<std::string> lines;
    for (std::string word; words >> word;) {
        if (!lines.empty() && display_width(lines.back()) + 1 + display_width(word) <= width)
            lines.back() += ' ' + word;
        else
            lines.push_back(word);
    }
    return lines;
}

std::string grouped(long long number) {
    std::string digits = std::to_string(number);
    const std::size_t first_digit = number < 0 ? 1 : 0;
    for (std::size_t end = digits.size(); end > first_digit + 3; end -= 3)
        digits.insert(end - 3, ",");
    return digits;
}

}  // namespace rddlc::workbench
