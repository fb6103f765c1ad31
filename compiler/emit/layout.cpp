#include "emit/layout.hpp"

#include <algorithm>

namespace rddlc::cpp {
namespace {

bool is_opening(char c) {
    return c == '(' || c == '[' || c == '{';
}
bool is_closing(char c) {
    return c == ')' || c == ']' || c == '}';
}

// Operands with the operator that follows: "a +", "b * c -", "d".
std::vector<std::string> split_chain(const std::string& text,
                                     const std::vector<std::string_view>& operators) {
    std::vector<std::string> pieces;
    std::size_t begin = 0;
    int depth = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (is_opening(text[i])) ++depth;
        if (is_closing(text[i])) --depth;
        if (depth > 0 || text[i] != ' ') continue;
        for (std::string_view op : operators) {
            const std::string spaced = " " + std::string(op) + " ";
            if (text.compare(i, spaced.size(), spaced) != 0) continue;
            const std::size_t end = i + spaced.size() - 1;
            pieces.push_back(text.substr(begin, end - begin));
            begin = end + 1;
            i = end;
            break;
        }
    }
    pieces.push_back(text.substr(begin));
    return pieces;
}

// "a, f(b, c), {d, e});" -> "a,", "f(b, c),", "{d, e});"
std::vector<std::string> split_arguments(const std::string& text) {
    std::vector<std::string> pieces(1);
    int depth = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (is_opening(text[i])) ++depth;
        if (is_closing(text[i])) --depth;
        pieces.back() += text[i];
        if (depth > 0 || text[i] != ',') continue;
        pieces.emplace_back();
        ++i;  // the blank
    }
    return pieces;
}

}  // namespace

std::vector<std::string> fill(const std::vector<std::string>& pieces, std::size_t column,
                              std::size_t reserve) {
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const std::size_t needed = pieces[i].size() + (i + 1 == pieces.size() ? reserve : 0);
        if (lines.empty()) {
            lines.push_back(pieces[i]);
        } else if (column + lines.back().size() + 1 + needed <= line_width) {
            lines.back() += " " + pieces[i];
        } else {
            lines.push_back(pieces[i]);
        }
    }
    return lines;
}

std::vector<std::string> fill_call(const std::string& text, std::size_t begin, std::size_t column) {
    const std::size_t bracket = text.find('(', begin) + 1;
    if (bracket == 0) return {text};
    const std::vector<std::string> pieces = split_arguments(text.substr(bracket));
    std::vector<std::string> lines = fill(pieces, column + bracket, 0);
    const bool fits = std::ranges::all_of(lines, [&](const std::string& line) {
        return column + bracket + line.size() <= line_width;
    });
    const std::string head = text.substr(0, bracket);
    if (fits) {
        for (std::size_t i = 1; i < lines.size(); ++i) lines[i].insert(0, bracket, ' ');
        lines[0].insert(0, head);
    } else {
        lines = fill(pieces, column + indentation, 0);
        for (std::string& line : lines) line.insert(0, indentation, ' ');
        lines.insert(lines.begin(), head);
    }
    return lines;
}

std::vector<std::string> fill_chain(const std::string& lead, const std::string& text,
                                    const std::vector<std::string_view>& operators,
                                    std::size_t column) {
    const std::vector<std::string> pieces = split_chain(text, operators);
    std::vector<std::string> aligned = fill(pieces, column + lead.size(), 0);
    aligned[0].insert(0, lead);
    for (std::size_t i = 1; i < aligned.size(); ++i) aligned[i].insert(0, lead.size(), ' ');
    if (!lead.ends_with("= ")) return aligned;

    std::vector<std::string> broken = fill(pieces, column + indentation, 0);
    for (std::string& line : broken) line.insert(0, indentation, ' ');
    broken.insert(broken.begin(), lead.substr(0, lead.size() - 1));
    const bool too_wide = std::ranges::any_of(
        aligned, [&](const std::string& line) { return column + line.size() > line_width; });
    return too_wide || broken.size() == 2 || broken.size() < aligned.size() ? broken : aligned;
}

std::vector<std::string> fill_call(const std::string& head,
                                   const std::vector<std::string>& arguments,
                                   const std::string& tail, std::size_t column) {
    if (arguments.empty()) return {head + tail};
    std::vector<std::string> pieces = arguments;
    for (std::size_t i = 0; i + 1 < pieces.size(); ++i) pieces[i] += ',';
    std::vector<std::string> lines = fill(pieces, column + head.size(), tail.size());
    lines[0].insert(0, head);
    for (std::size_t i = 1; i < lines.size(); ++i) lines[i].insert(0, head.size(), ' ');
    lines.back() += tail;
    return lines;
}

}  // namespace rddlc::cpp
