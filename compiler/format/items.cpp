#include "format/items.hpp"

#include <algorithm>
#include <span>

namespace rddlc::format {

namespace {

std::vector<std::size_t> column_widths(std::span<const Item> items) {
    std::vector<std::size_t> widths;
    for (const Item& item : items) {
        widths.resize(std::max(widths.size(), item.cells.size()));
        for (std::size_t i = 0; i < item.cells.size(); ++i)
            widths[i] = std::max(widths[i], item.cells[i].size());
    }
    return widths;
}

std::string in_columns(const Item& item, const std::vector<std::size_t>& widths) {
    std::string text;
    for (std::size_t i = 0; i < item.cells.size(); ++i) {
        text += item.cells[i];
        const std::size_t width = i < widths.size() ? widths[i] : 0;
        if (width > item.cells[i].size()) text.append(width - item.cells[i].size(), ' ');
        text += ' ';
    }
    return text;
}

// A line that fits on the page by itself must not leave it because of its neighbours.
bool aligns(std::span<const Item> items, std::size_t indent,
            const std::vector<std::size_t>& widths) {
    constexpr std::size_t widest_gap = 32;
    return std::all_of(items.begin(), items.end(), [&](const Item& item) {
        const std::size_t alone = in_columns(item, {}).size();
        const std::size_t aligned = in_columns(item, widths).size();
        if (aligned - alone > widest_gap) return false;
        if (flat_width(item.rest) == unbounded) return true;
        const std::size_t rest = indent + flat_width(item.rest);
        return alone + rest > page_width || aligned + rest <= page_width;
    });
}

bool continues_paragraph(const Item& above, const Item& below) {
    return !below.lead.separates() && !above.cells.empty() && !below.cells.empty();
}

void print_paragraph(std::span<const Item> items, std::size_t indent,
                     std::vector<TextLine>& lines) {
    std::vector<std::size_t> widths = column_widths(items);
    if (!aligns(items, indent, widths)) widths.clear();
    for (const Item& item : items) {
        print_lead(item.lead, indent, lines);
        render(item.rest, std::string(indent, ' ') + in_columns(item, widths), indent, lines);
    }
}

// ------------------------------------------------------------------------------------ comments

std::size_t indent_of(std::string_view text) {
    return std::min(text.find_first_not_of(' '), text.size());
}

bool is_comment(std::string_view text) {
    return text.substr(indent_of(text)).starts_with("//");
}

// Whether the comments behind two lines in a row are aligned.
bool belong_together(const TextLine& above, const TextLine& below) {
    if (below.text.empty()) return !below.comment.empty() && !above.comment.empty();
    return !above.text.empty() && !is_comment(above.text) && !is_comment(below.text) &&
           indent_of(above.text) == indent_of(below.text);
}

std::size_t comment_column(std::span<const TextLine> lines) {
    constexpr std::size_t widest_gap = 40;
    std::size_t shortest = unbounded, column = 0;
    for (const TextLine& line : lines)
        if (!line.comment.empty() && !line.text.empty())
            shortest = std::min(shortest, line.text.size());
    for (const TextLine& line : lines)
        if (!line.comment.empty() && line.text.size() <= shortest + widest_gap)
            column = std::max(column, line.text.size());
    return column + 2;
}

void join_block(std::span<const TextLine> lines, std::string& text) {
    const std::size_t column = comment_column(lines);
    std::size_t last_column = column;  // which a continued comment keeps
    for (const TextLine& line : lines) {
        text += line.text;
        if (!line.comment.empty()) {
            if (!line.text.empty()) last_column = std::max(column, line.text.size() + 2);
            text.append(last_column - line.text.size(), ' ').append(line.comment);
        }
        text += '\n';
    }
}

}  // namespace

void print_lead(const Lead& lead, std::size_t indent, std::vector<TextLine>& lines) {
    for (const CommentAbove& comment : lead.comments) {
        if (comment.blank_line_before) lines.emplace_back();
        lines.push_back({std::string(indent, ' ').append(comment.text), {}});
    }
    if (lead.blank_line_before) lines.emplace_back();
}

void print_items(const std::vector<Item>& items, std::size_t indent, std::vector<TextLine>& lines) {
    for (std::size_t begin = 0; begin < items.size();) {
        std::size_t end = begin + 1;
        while (end < items.size() && continues_paragraph(items[end - 1], items[end])) ++end;
        print_paragraph(std::span(items).subspan(begin, end - begin), indent, lines);
        begin = end;
    }
}

std::string join(const std::vector<TextLine>& lines) {
    std::string text;
    for (std::size_t begin = 0; begin < lines.size();) {
        std::size_t end = begin + 1;
        while (end < lines.size() && belong_together(lines[end - 1], lines[end])) ++end;
        const bool is_blank = lines[begin].text.empty() && lines[begin].comment.empty();
        if (!is_blank || (!text.empty() && !text.ends_with("\n\n")))
            join_block(std::span(lines).subspan(begin, end - begin), text);
        begin = end;
    }
    while (text.ends_with("\n\n")) text.pop_back();
    return text;
}

}  // namespace rddlc::format
