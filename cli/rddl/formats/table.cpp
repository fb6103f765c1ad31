#include "formats/table.hpp"

#include <algorithm>
#include <sstream>

namespace rddlc::cli {

namespace {

bool begins_code_point(char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0) != 0x80;
}

void trim_trailing_blanks(std::string& text) {
    text.erase(text.find_last_not_of(' ') + 1);
}

}  // namespace

std::size_t display_width(std::string_view text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_code_point));
}

void Table::add_row(std::vector<std::string> cells) {
    cells.resize(columns_.size());
    rows_.push_back(std::move(cells));
}

std::string Table::text(std::size_t indent) const {
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
    std::size_t columns = 0;
    for (const char byte : text) {
        if (begins_code_point(byte) && ++columns == width) break;
        out += byte;
    }
    return out + "…";
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

}  // namespace rddlc::cli
