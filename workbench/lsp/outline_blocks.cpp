// Blocks, sections and where their items end.
#include "lsp/outline_reader.hpp"

#include <algorithm>
#include <optional>

namespace rddlc::lsp {

namespace {

std::optional<Meaning> block_named(std::string_view keyword) {
    if (keyword == "domain") return Meaning::Domain;
    if (keyword == "non-fluents") return Meaning::NonFluents;
    if (keyword == "instance") return Meaning::Instance;
    if (keyword == "policy") return Meaning::Policy;
    return std::nullopt;
}

constexpr std::string_view sections[] = {"requirements",
                                         "types",
                                         "pvariables",
                                         "cpfs",
                                         "cdfs",
                                         "reward",
                                         "termination",
                                         "action-preconditions",
                                         "state-action-constraints",
                                         "state-invariants",
                                         "objects",
                                         "init-state",
                                         "max-nondef-actions",
                                         "horizon",
                                         "discount",
                                         "non-fluents",
                                         "domain"};

// The text behind the name of an item; empty if such items have no names.
std::string_view separator_of(std::string_view section) {
    if (section == "types" || section == "pvariables" || section == "objects") return ":";
    const bool has_names = section == "cpfs" || section == "cdfs" || section == "init-state" ||
                           section == "non-fluents";
    return has_names ? "=" : "";
}

}  // namespace

void OutlineReader::read() {
    for (std::size_t at = 0; at < tokens_.size();) at = begins_block(at) ? read_block(at) : at + 1;
}

// ------------------------------------------------------------------------------------- blocks

bool OutlineReader::begins_block(std::size_t at) const {
    return block_named(word(at)) && is_name_at(at + 1);
}

bool OutlineReader::begins_section(std::size_t at) const {
    const std::string_view next = word(at + 1);
    if (next != "{" && next != "=") return false;
    return !word(at).empty() && std::ranges::find(sections, word(at)) != std::end(sections);
}

std::size_t OutlineReader::read_block(std::size_t at) {
    Block block{*block_named(word(at)), name(at), name(at + 1), {}, {}, {}, {}};
    note(block.kind, at + 1, true);
    std::size_t next = at + 2;
    if (word(next) == "{") ++next;
    while (next < tokens_.size() && !begins_block(next) && word(next) != "}")
        next = begins_section(next) ? read_section(next, block) : next + 1;
    if (word(next) == "}") ++next;
    if (word(next) == ";") ++next;
    block.whole = whole(at, next);
    outline_.blocks.push_back(std::move(block));
    return next;
}

// ----------------------------------------------------------------------------------- sections

// The token behind it.
std::size_t OutlineReader::read_section(std::size_t at, Block& block) {
    Section section{name(at), {}, {}};
    std::size_t open = at + 1;
    if (word(open) == "=" && word(open + 1) == "{") ++open;
    std::size_t depth = 0;
    std::size_t end = open;
    for (; end < tokens_.size() && !word(end).empty(); ++end) {
        if (end > open && (begins_section(end) || begins_block(end))) break;
        if (word(end) == "{") ++depth;
        if (word(end) == "}" && (depth == 0 || (--depth == 0 && word(open) == "{"))) break;
        if (word(end) == ";" && depth == 0) break;
    }
    if (word(open) == "{")
        read_items(open + 1, end, block, section);
    else
        read_setting(open + 1, end, block, section);
    const bool closes_block = word(end) == "}" && word(open) != "{";
    if (word(end) == "}" && !closes_block) ++end;
    if (word(end) == ";") ++end;
    section.whole = whole(at, end);
    block.sections.push_back(std::move(section));
    return std::max(end, at + 1);
}

// keyword = ...;
void OutlineReader::read_setting(std::size_t at, std::size_t end, Block& block, Section& section) {
    const bool names = section.keyword.text == "domain" || section.keyword.text == "non-fluents";
    if (!names) {
        first_binding_ = outline_.bindings.size();
        return read_expression(at, end);
    }
    if (at >= end || !is_name_at(at)) return;
    const bool is_domain = section.keyword.text == "domain";
    (is_domain ? block.domain : block.non_fluents) = word(at);
    note(is_domain ? Meaning::Domain : Meaning::NonFluents, at);
}

// -------------------------------------------------------------------------------------- items

void OutlineReader::read_items(std::size_t at, std::size_t end, const Block& block,
                               Section& section) {
    const std::string_view separator = separator_of(section.keyword.text);
    while (at < end) {
        const std::size_t next = item_end(at, end, separator);
        read_item(at, next, block, section);
        at = next;
    }
}

// A new item at the beginning of a line: "p(...) :", "p'(...) =" or "t :".
bool OutlineReader::begins_item(std::size_t at, std::string_view separator) const {
    if (separator.empty() || !tokens_[at].begins_line() || !is_name_at(at)) return false;
    std::size_t next = at + 1;
    if (word(next) == "(") next = closing(next, tokens_.size()) + 1;
    return word(next) == separator;
}

// The token behind the item that begins at a token: behind its ';', or where the next one begins.
std::size_t OutlineReader::item_end(std::size_t at, std::size_t end,
                                    std::string_view separator) const {
    std::size_t depth = 0;
    for (std::size_t i = at; i < end; ++i) {
        const std::string_view mark = word(i);
        if (i > at && begins_item(i, separator)) return i;
        if (mark == "{" || mark == "(" || mark == "[") ++depth;
        if ((mark == "}" || mark == ")" || mark == "]") && depth > 0) --depth;
        if (mark == ";" && depth == 0) return i + 1;
    }
    return end;
}

}  // namespace rddlc::lsp
