#include "lsp/completion_place.hpp"

#include <algorithm>

namespace rddlc::lsp {

namespace {

using Kind = CompletionPlace::Kind;

bool is_word(std::string_view token) {
    const char first = token.empty() ? ' ' : token.front();
    return first == '?' || first == '@' || (first >= 'a' && first <= 'z') ||
           (first >= 'A' && first <= 'Z') || (first >= '0' && first <= '9') || first == '.';
}

bool is_opener(std::string_view mark) {
    return mark == "(" || mark == "[" || mark == "{";
}

bool is_closer(std::string_view mark) {
    return mark == ")" || mark == "]" || mark == "}";
}

class PlaceFinder {
  public:
    PlaceFinder(const Lookup& lookup, std::uint32_t offset)
        : lookup_(lookup), file_(*lookup.file()), offset_(offset) {}

    CompletionPlace find() {
        place_.replaced = {offset_, offset_};
        if (!in_comment()) {
            find_words();
            find_kind();
        }
        return place_;
    }

  private:
    bool in_comment() const {
        const std::string_view before = file_.text.of({0, offset_});
        const std::size_t line = before.find_last_of("\r\n") + 1;
        return before.find("//", line) != before.npos;
    }

    std::uint32_t begin_of(const format::Token& token) const {
        return static_cast<std::uint32_t>(token.text.data() - file_.text.string().data());
    }

    // The word at the cursor, and the tokens before it.
    void find_words() {
        for (const format::Token& token : file_.outline.tokens) {
            const std::uint32_t begin = begin_of(token);
            if (token.text.empty() || begin >= offset_) break;
            const auto end = begin + static_cast<std::uint32_t>(token.text.size());
            if (end >= offset_ && is_word(token.text)) {
                place_.replaced = {begin, end};
                place_.text = token.text.substr(0, offset_ - begin);
                continue;
            }
            before_.push_back(&token);
        }
    }

    // `distance` tokens before the word; the one directly before is 1. Empty for 0 and beyond the
    // section.
    std::string_view before(std::size_t distance = 1) const {
        const bool is_there = distance > 0 && distance <= before_.size() - first_;
        return is_there ? before_[before_.size() - distance]->text : std::string_view();
    }

    bool begins_line() const {
        if (before_.empty()) return true;
        const std::uint32_t end =
            begin_of(*before_.back()) + static_cast<std::uint32_t>(before_.back()->text.size());
        return file_.text.of({end, place_.replaced.begin}).find('\n') != std::string_view::npos;
    }

    // A part of the text is over if it has been closed before the cursor.
    bool is_over(Place whole) const {
        const std::string_view text = file_.text.of(whole);
        const bool is_closed = text.ends_with('}') || text.ends_with(';');
        return is_closed && whole.end <= place_.replaced.begin;
    }

    void find_kind() {
        const bool is_number =
            !place_.text.empty() && place_.text.front() >= '.' && place_.text.front() <= '9';
        if (is_number) return;
        const Block* block = nullptr;
        for (const Block& each : file_.outline.blocks)
            if (each.whole.begin < place_.replaced.begin) block = &each;
        if (!block || is_over(block->whole)) {
            place_.kind = Kind::Block;
            return;
        }
        place_.in_policy = block->kind == Meaning::Policy;
        const Section* section = nullptr;
        for (const Section& each : block->sections)
            if (each.whole.begin < place_.replaced.begin) section = &each;
        if (before(2) == "domain" || before(2) == "instance" || before() == "domain") {
            const bool is_name_of_block = !section && before() != "{";
            if (is_name_of_block) return;
        }
        if (!section || is_over(section->whole)) {
            place_.kind = section_in(*block);
            return;
        }
        while (first_ < before_.size() && begin_of(*before_[first_]) < section->whole.begin)
            ++first_;
        find_in(*section, *block);
    }

    static Kind section_in(const Block& block) {
        if (block.kind == Meaning::NonFluents) return Kind::NonFluentsSection;
        return block.kind == Meaning::Instance ? Kind::InstanceSection : Kind::DomainSection;
    }

    void find_in(const Section& section, const Block& block) {
        const std::string_view keyword = section.keyword.text;
        const bool is_setting = before_.size() > first_ + 1 && before_[first_ + 1]->text == "=";
        const bool has_values = keyword == "init-state" || keyword == "non-fluents";
        if (keyword == "types")
            place_.kind = before() == ":" ? Kind::TypeForm : Kind::Nothing;
        else if (keyword == "pvariables")
            find_in_declaration();
        else if (keyword == "cpfs" || keyword == "cdfs")
            find_in_cpf();
        else if (keyword == "objects")
            place_.kind = before() == ";" || before(2) == keyword ? Kind::Type : Kind::Nothing;
        else if (is_setting && (keyword == "domain" || keyword == "non-fluents"))
            find_block_name(keyword);
        else if (has_values)
            find_in_assignment(keyword);
        else if (block.kind == Meaning::Domain && keyword != "requirements")
            find_in_expression();
    }

    void find_block_name(std::string_view keyword) {
        if (before() != "=") return;
        place_.kind = Kind::BlockName;
        place_.word = keyword;
    }

    // How far before the word the innermost open bracket is; 0 if none is open. An item's end ends
    // the search.
    std::size_t innermost_open() const {
        std::size_t closed = 0;
        for (std::size_t distance = 1; !before(distance).empty(); ++distance) {
            const std::string_view mark = before(distance);
            if (mark == ";") return 0;
            if (is_closer(mark)) ++closed;
            if (is_opener(mark) && closed-- == 0) return distance;
        }
        return 0;
    }

    std::size_t commas_since(std::size_t open) const {
        std::size_t commas = 0;
        for (std::size_t distance = 1; distance < open; ++distance)
            commas += before(distance) == "," ? 1 : 0;
        return commas;
    }

    // The distance of the first token of the item: behind the section's '{' or a ';'. 0 if the
    // section has not begun.
    std::size_t item_begin() const {
        std::size_t depth = 0;
        std::size_t distance = 1;
        for (; !before(distance).empty(); ++distance) {
            const std::string_view mark = before(distance);
            if (is_closer(mark)) ++depth;
            if (mark == ";" && depth == 0) break;
            if (is_opener(mark) && depth > 0) --depth;
        }
        const bool is_first = before(distance).empty();
        const std::size_t others = is_first ? 3 : 1;  // 'keyword {' stands before the first one
        return distance > others ? distance - others : 0;
    }

    void find_in_declaration() {
        const std::size_t open = innermost_open();
        if (before(open) == "(") {
            place_.kind = Kind::Type;
            return;
        }
        const bool is_of_section = open == 0 || before(open + 1) != ":";
        if (is_of_section) return;
        const std::size_t commas = commas_since(open);
        if (before() == "{") place_.kind = Kind::FluentKind;
        if (before() == "," && commas == 1) place_.kind = Kind::Range;
        if (before() == "," && commas > 1) place_.kind = Kind::Attribute;
        if (before() != "=") return;
        place_.kind = Kind::Constant;
        place_.word = before(open - 3);
    }

    void find_in_cpf() {
        const bool is_begin = before() == ";" || (before() == "{" && before(3).empty());
        if (is_begin) {
            place_.kind = Kind::Definition;
            return;
        }
        bool is_body = false;
        for (std::size_t distance = 1; distance <= item_begin(); ++distance)
            is_body = is_body || before(distance) == "=";
        if (is_body) find_in_expression();
    }

    void find_in_expression() {
        const std::size_t open = innermost_open();
        const bool in_binder = open > 0 && before(open) == "{" && before(open + 1) == "_";
        const bool wants_type =
            (in_binder && before() == ":") || (before() == "(" && before(2).ends_with("Discrete"));
        if (wants_type)
            place_.kind = Kind::Type;
        else if (in_binder)
            place_.kind = Kind::Nothing;
        else if (place_.text.starts_with('?'))
            place_.kind = Kind::Variable;
        else if (place_.text.starts_with('@'))
            place_.kind = Kind::Value;
        else
            place_.kind = Kind::Expression;
    }

    void find_in_assignment(std::string_view section) {
        const std::size_t open = innermost_open();
        if (before(open) == "(") return find_argument(open);
        if (before() == "=") return find_constant();
        const bool is_begin = before() == ";" || before() == "{" || before() == "~";
        if (!is_begin && !begins_line()) return;
        place_.kind = Kind::Assignment;
        place_.word = section;
    }

    void find_argument(std::size_t open) {
        const auto fluent = lookup_.fluent(before(open + 1));
        const std::size_t index = commas_since(open);
        if (!fluent || index >= fluent->declaration->parameters.size()) return;
        place_.kind = Kind::Argument;
        place_.word = fluent->declaration->parameters[index].text;
    }

    void find_constant() {
        const auto fluent = lookup_.fluent(before(item_begin()));
        if (!fluent) return;
        place_.kind = Kind::Constant;
        place_.word = fluent->declaration->range.text;
    }

    const Lookup& lookup_;
    const File& file_;
    std::uint32_t offset_;
    CompletionPlace place_;
    std::vector<const format::Token*> before_;
    std::size_t first_ = 0;  // of the section
};

}  // namespace

CompletionPlace completion_place(const Lookup& lookup, std::uint32_t offset) {
    return PlaceFinder(lookup, offset).find();
}

}  // namespace rddlc::lsp
