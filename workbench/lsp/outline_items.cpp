// Declarations, definitions and values.
#include "lsp/outline_reader.hpp"
#include "lsp/words.hpp"

#include <algorithm>

namespace rddlc::lsp {

// --------------------------------------------------------------------------------- the tokens

Place OutlineReader::place(std::size_t at) const {
    const std::string_view token = word(at);
    if (token.data() == nullptr) {
        const auto end = static_cast<std::uint32_t>(text_.size());
        return {end, end};
    }
    const auto begin = static_cast<std::uint32_t>(token.data() - text_.data());
    return {begin, begin + static_cast<std::uint32_t>(token.size())};
}

Name OutlineReader::name(std::size_t at) const {
    Name result{word(at), place(at)};
    if (result.text.starts_with('?') || result.text.starts_with('@')) {
        result.text.remove_prefix(1);
        ++result.place.begin;
    }
    if (result.text.ends_with('\'')) {
        result.text.remove_suffix(1);
        --result.place.end;
    }
    return result;
}

bool OutlineReader::is_name_at(std::size_t at) const {
    std::string_view text = word(at);
    if (text.ends_with('\'')) text.remove_suffix(1);
    return is_name(text) && !is_reserved(word(at));
}

// The bracket that closes the one at `open`, or `end`.
std::size_t OutlineReader::closing(std::size_t open, std::size_t end) const {
    std::size_t depth = 0;
    for (std::size_t i = open; i < end; ++i) {
        const std::string_view mark = word(i);
        if (mark == "(" || mark == "[" || mark == "{") ++depth;
        if ((mark == ")" || mark == "]" || mark == "}") && --depth == 0) return i;
        if (mark == ";") return i;
    }
    return end;
}

Place OutlineReader::whole(std::size_t at, std::size_t end) const {
    return {place(at).begin, end > at ? place(end - 1).end : place(at).end};
}

// The lines of comments above the first of some tokens, without a blank line between, and those
// behind the last one.
std::string OutlineReader::comment(std::size_t at, std::size_t end) const {
    std::vector<std::string_view> lines;
    if (at < tokens_.size() && !tokens_[at].has_blank_line_before())
        for (const format::CommentAbove& above : tokens_[at].above) {
            if (above.blank_line_before) lines.clear();
            lines.push_back(above.text);
        }
    if (end > at)
        lines.insert(lines.end(), tokens_[end - 1].behind.begin(), tokens_[end - 1].behind.end());
    std::string result;
    for (std::string_view line : lines) {
        line.remove_prefix(std::min(line.find_first_not_of("/ \t"), line.size()));
        const bool is_ruler = line.find_first_not_of("-=*#_~ ") == line.npos;
        if (!is_ruler) result += (result.empty() ? "" : "\n") + std::string(line);
    }
    return result;
}

void OutlineReader::note(Meaning meaning, std::size_t at, bool declares) {
    outline_.occurrences.push_back({meaning, name(at), declares, 0});
}

// ---------------------------------------------------------------------------------- the items

void OutlineReader::read_item(std::size_t at, std::size_t end, const Block& block,
                              Section& section) {
    first_binding_ = outline_.bindings.size();
    const std::string_view keyword = section.keyword.text;
    const bool is_value =
        keyword == "init-state" || (keyword == "non-fluents" && block.kind != Meaning::Domain);
    Item item{{}, whole(at, end)};
    const std::size_t first = word(at) == "~" ? at + 1 : at;
    const bool is_condition = keyword.starts_with("state-") || keyword.ends_with("preconditions") ||
                              keyword == "termination";
    if (first < end && is_name_at(first) && !is_condition) item.name = name(first);
    if (keyword == "types")
        read_type(at, end);
    else if (keyword == "pvariables")
        read_fluent(at, end);
    else if (keyword == "cpfs" || keyword == "cdfs")
        read_cpf(at, end);
    else if (keyword == "objects")
        read_list(at, end);
    else if (is_value)
        read_assignment(first, end);
    else if (keyword != "requirements")
        read_expression(at, end);
    section.items.push_back(item);
}

// t : object;   t : {@a, @b};
void OutlineReader::read_type(std::size_t at, std::size_t end) {
    if (!is_name_at(at)) return;
    note(Meaning::Type, at, true);
    TypeDeclaration type{name(at), {}, whole(at, end), comment(at, end)};
    for (std::size_t i = at + 1; i < end; ++i) {
        if (word(i) == "{") type.members.emplace();
        const bool is_member = type.members && (word(i).starts_with('@') || is_name_at(i));
        if (!is_member) continue;
        type.members->push_back(name(i));
        note(Meaning::Object, i, true);
    }
    outline_.types.push_back(std::move(type));
}

// p(t, u) : { state-fluent, bool, default = false };
void OutlineReader::read_fluent(std::size_t at, std::size_t end) {
    if (!is_name_at(at)) return;
    note(Meaning::Fluent, at, true);
    FluentDeclaration fluent{name(at), {}, {}, {}, whole(at, end), comment(at, end)};
    std::size_t i = at + 1;
    if (word(i) == "(")
        for (++i; i < end && word(i) != ")" && word(i) != ":"; ++i)
            if (is_name_at(i)) {
                fluent.parameters.push_back(name(i));
                note(Meaning::Type, i);
            }
    while (i < end && word(i) != "{") ++i;
    if (i + 1 < end) fluent.kind = name(i + 1);
    if (i + 3 < end && word(i + 2) == ",") {
        fluent.range = name(i + 3);
        if (is_name_at(i + 3)) note(Meaning::Type, i + 3);
    }
    for (i += 4; i < end; ++i)
        if (word(i - 1) == "=" && (is_name_at(i) || word(i).starts_with('@')))
            note(Meaning::Object, i);
    outline_.fluents.push_back(std::move(fluent));
}

// p'(?x, ?y) = ...;
void OutlineReader::read_cpf(std::size_t at, std::size_t end) {
    if (!is_name_at(at)) return;
    note(Meaning::Fluent, at);
    std::size_t body = at + 1;
    const Place scope = whole(at, end);
    if (word(body) == "(")
        for (++body; body < end && word(body) != ")" && word(body) != "="; ++body)
            if (word(body).starts_with('?')) outline_.bindings.push_back({name(body), {}, scope});
    read_expression(at + 1, end);
}

// t : {a, b, c};
void OutlineReader::read_list(std::size_t at, std::size_t end) {
    if (!is_name_at(at)) return;
    note(Meaning::Type, at);
    ObjectList list{name(at), {}};
    for (std::size_t i = at + 1; i < end; ++i)
        if (is_name_at(i) || word(i).starts_with('@')) {
            list.objects.push_back(name(i));
            note(Meaning::Object, i, true);
        }
    outline_.lists.push_back(std::move(list));
}

// p(a, b) = 3;
void OutlineReader::read_assignment(std::size_t at, std::size_t end) {
    if (at >= end || !is_name_at(at)) return;
    note(Meaning::Fluent, at);
    std::size_t i = at + 1;
    for (; i < end && word(i) != "="; ++i)
        if (is_name_at(i) || word(i).starts_with('@')) note(Meaning::Object, i);
    const bool is_constant = i + 2 >= end || word(i + 2) == ";";
    if (is_constant && i + 1 < end && (is_name_at(i + 1) || word(i + 1).starts_with('@')))
        note(Meaning::Object, i + 1);
    else
        read_expression(i, end);
}

}  // namespace rddlc::lsp
