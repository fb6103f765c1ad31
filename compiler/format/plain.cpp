#include "format/plain.hpp"

namespace rddlc::format {

namespace {

bool opens(std::string_view token) {
    return token == "(" || token == "{";
}
bool closes(std::string_view token) {
    return token == ")" || token == "}";
}

// "p(a, b) : { non-fluent, real, default = -0.5 };", but "t : {@a, @b};"
std::string_view space_between(std::string_view left, std::string_view right) {
    if (right == "," || right == ";" || right == "(" || opens(left) || closes(right)) return "";
    if (left == "~" || left == "-") return "";
    return " ";
}

Doc plain_list(Cursor& cursor);

// A token, or brackets and what is in them.
Doc plain_word(Cursor& cursor) {
    if (!opens(cursor.next().text)) return cursor.take();
    Doc open = cursor.take();
    const Doc padding = text(cursor.next().text.ends_with("-fluent") ? " " : "");
    Doc list = plain_list(cursor);
    return concat({std::move(open), padding, align(std::move(list)), padding, cursor.take()});
}

// Up to a closing bracket.
Doc plain_list(Cursor& cursor) {
    std::vector<Doc> parts;
    while (!closes(cursor.next().text)) {
        const std::string_view last = cursor.next().text;
        parts.push_back(plain_word(cursor));
        const std::string space(space_between(last, cursor.next().text));
        parts.push_back(last == "," ? group(line(space), cursor.next().begins_line())
                                    : text(space));
    }
    return concat(std::move(parts));
}

}  // namespace

Doc plain(Cursor& cursor, std::string_view stop) {
    std::vector<Doc> parts;
    while (true) {
        const std::string_view last = cursor.next().text;
        parts.push_back(plain_word(cursor));
        if (last == stop) return concat(std::move(parts));
        const std::string_view before = opens(last) ? (last == "(" ? ")" : "}") : last;
        parts.push_back(text(std::string(space_between(before, cursor.next().text))));
    }
}

Doc plain_before(Cursor& cursor, std::string_view stop) {
    std::vector<Doc> parts;
    while (!cursor.is_at(stop)) {
        const std::string_view last = cursor.next().text;
        parts.push_back(cursor.take());
        parts.push_back(text(std::string(space_between(last, cursor.next().text))));
    }
    return concat(std::move(parts));
}

std::string plain_text(Cursor& cursor, std::string_view stop) {
    std::string result;
    while (!cursor.is_at(stop)) {
        const std::string_view last = cursor.next().text;
        cursor.take();
        result.append(last);
        if (!cursor.is_at(stop)) result.append(space_between(last, cursor.next().text));
    }
    return result;
}

bool has_comments_inside(const Cursor& cursor, std::string_view stop) {
    for (std::size_t k = 0;; ++k) {
        const Token& token = cursor.ahead(k);
        if (k > 0 && !token.above.empty()) return true;
        if (token.text == stop || token.text.empty()) return false;
        if (!token.behind.empty()) return true;
    }
}

}  // namespace rddlc::format
