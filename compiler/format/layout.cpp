#include "format/layout.hpp"

#include "format/assignments.hpp"
#include "format/expressions.hpp"
#include "format/items.hpp"
#include "format/plain.hpp"
#include "support/match.hpp"

#include <algorithm>

namespace rddlc::format {

namespace {

class Layout {
  public:
    explicit Layout(std::vector<Token> tokens) : cursor_(std::move(tokens)) {}

    std::vector<TextLine> layout(const ast::Program& program) {
        bool is_first = true;
        for (const ast::Block& block : program.blocks) {
            print_lead_of_part(!is_first);
            match(block, [&](const auto& node) { print(node.sections); });
            is_first = false;
        }
        print_lead(cursor_.take_lead(), 0, lines_);
        return std::move(lines_);
    }

  private:
    // -------------------------------------------------------------------- blocks and sections

    template <class Section>
    void print(const std::vector<Section>& sections) {
        print_in_brackets([&] {
            bool after_list = false;  // of declarations, which a blank line sets apart
            bool is_first = true;
            for (const Section& section : sections) {
                const bool is_list =
                    match(section.node, [](const auto& node) { return has_list(node); });
                print_lead_of_part(!is_first && (is_list || after_list));
                match(section.node, [&](const auto& node) { print(node); });
                after_list = is_list;
                is_first = false;
            }
        });
    }

    static bool has_list(const ast::Requirements&) { return false; }
    static bool has_list(const ast::Reward&) { return false; }
    static bool has_list(const ast::DomainName&) { return false; }
    static bool has_list(const ast::NonFluentsName&) { return false; }
    static bool has_list(const ast::MaxNondefActions&) { return false; }
    static bool has_list(const ast::Horizon&) { return false; }
    static bool has_list(const ast::Discount&) { return false; }
    template <class Node>
    static bool has_list(const Node&) {
        return true;
    }

    // Prints the comments above a block or a section.
    void print_lead_of_part(bool set_apart) {
        Lead lead = cursor_.take_lead();
        const bool has_blank_line =
            lead.blank_line_before ||
            std::any_of(lead.comments.begin(), lead.comments.end(),
                        [](const CommentAbove& comment) { return comment.blank_line_before; });
        if (set_apart && !has_blank_line) lines_.emplace_back();
        print_lead(lead, indent_, lines_);
    }

    // "types {", the contents one level deeper, "};"
    template <class PrintContents>
    void print_in_brackets(PrintContents print_contents) {
        Doc before = plain_before(cursor_, "{");
        Doc head = concat({std::move(before), cursor_.take("{")});
        const bool is_empty = cursor_.is_at("}") && cursor_.next().above.empty();
        if (!is_empty) {
            print_line(head);
            head = text("");
            indent_ += indentation;
            print_contents();
            Lead lead = cursor_.take_lead();
            lead.blank_line_before = false;
            print_lead(lead, indent_, lines_);
            indent_ -= indentation;
        }
        Doc close = cursor_.take("}");
        print_line(concat({head, std::move(close), semicolon()}));
    }

    Doc semicolon() { return cursor_.is_at(";") ? cursor_.take() : text(""); }

    void print_line(const Doc& doc) { render(doc, std::string(indent_, ' '), indent_, lines_); }

    // --------------------------------------------------------------------------- declarations

    void print(const ast::Requirements&) { print_line(plain(cursor_, ";")); }
    void print(const ast::DomainName&) { print_line(plain(cursor_, ";")); }
    void print(const ast::NonFluentsName&) { print_line(plain(cursor_, ";")); }
    void print(const ast::MaxNondefActions&) { print_line(plain(cursor_, ";")); }
    void print(const ast::Discount&) { print_line(plain(cursor_, ";")); }

    void print(const ast::Types&) {
        print_items_in_brackets([&] { return declaration(); });
    }
    void print(const ast::Objects&) {
        print_items_in_brackets([&] { return declaration(); });
    }
    void print(const ast::PVariables&) {
        print_items_in_brackets([&] { return pvariable(); });
    }
    void print(const ast::NonFluentValues& values) { print_values(values.assignments); }
    void print(const ast::InitState& values) { print_values(values.assignments); }
    void print_values(const std::vector<ast::Assignment>& assignments) {
        print_in_brackets([&] { print_assignments(assignments, cursor_, indent_, lines_); });
    }

    template <class ReadItem>
    void print_items_in_brackets(ReadItem read_item) {
        print_in_brackets([&] {
            std::vector<Item> items;
            while (!cursor_.is_at("}")) items.push_back(read_item());
            print_items(items, indent_, lines_);
        });
    }

    // "name" ": what;"
    Item declaration() {
        Lead lead = cursor_.take_lead();
        std::vector<std::string> cells;
        if (!has_comments_inside(cursor_, ";")) cells.push_back(plain_text(cursor_, ":"));
        return {std::move(lead), std::move(cells), nest(plain(cursor_, ";"))};
    }

    // "name(types)" ": { kind," "type," "default = value };"
    Item pvariable() {
        Lead lead = cursor_.take_lead();
        if (has_comments_inside(cursor_, ";"))
            return {std::move(lead), {}, nest(plain(cursor_, ";"))};
        std::vector<std::string> cells{plain_text(cursor_, ":")};
        cursor_.take(":");
        cursor_.take("{");
        cells.push_back(": { " + plain_text(cursor_, ",") + ",");
        cursor_.take(",");
        std::string range(cursor_.next().text);
        cursor_.take();
        if (cursor_.is_at(",")) {
            cells.push_back(range + ",");
            cursor_.take();
            range = plain_text(cursor_, "}");
        }
        Doc close = cursor_.take("}");
        return {std::move(lead), std::move(cells),
                concat({text(range + " "), std::move(close), cursor_.take(";")})};
    }

    // ----------------------------------------------------------------------------- equations

    void print(const ast::Reward& reward) {
        Doc head = plain_before(cursor_, "=");
        const std::size_t width = flat_width(head);
        print_line(concat({std::move(head), equation(reward.value, width)}));
    }

    void print(const ast::Cpfs& cpfs) {
        print_in_brackets([&] {
            std::vector<Item> items;
            for (const ast::Cpf& cpf : cpfs.definitions) items.push_back(definition(cpf));
            print_items(items, indent_, lines_);
        });
    }

    void print(const ast::Constraints& constraints) {
        print_in_brackets([&] {
            for (const ast::Expr& condition : constraints.conditions) {
                print_lead(cursor_.take_lead(), indent_, lines_);
                Doc expression = layout_expression(condition, cursor_);
                print_line(concat({std::move(expression), cursor_.take(";")}));
            }
        });
    }

    Item definition(const ast::Cpf& cpf) {
        Lead lead = cursor_.take_lead();
        if (has_comments_inside(cursor_, "=")) {
            Doc head = plain_before(cursor_, "=");
            return {std::move(lead),
                    {},
                    nest(concat({std::move(head), equation(cpf.body, unbounded)}))};
        }
        std::string head = plain_text(cursor_, "=");
        Doc right = equation(cpf.body, head.size() + 1);
        return {std::move(lead), {std::move(head)}, std::move(right)};
    }

    // "= value;" behind a head of the given width. A value that is longer than a line begins below
    // the head if it is so written, or the head is long.
    Doc equation(const ast::Expr& value, std::size_t head_width) {
        constexpr std::size_t long_head = 32;
        const bool has_comment = !cursor_.next().behind.empty();
        Doc equals = cursor_.take("=");
        const bool is_below = cursor_.next().begins_line();
        const bool must_be_below = has_comment || !cursor_.next().above.empty();
        Doc right = layout_expression(value, cursor_);
        Doc end = cursor_.take(";");
        const bool may_be_below = !hugs(value) || std::holds_alternative<ast::Binary>(value.node);
        const bool fits = head_width != unbounded && flat_width(right) != unbounded &&
                          indent_ + head_width + flat_width(right) + 3 <= page_width;
        if (must_be_below || (!fits && may_be_below && (is_below || head_width > long_head)))
            right = nest(group(concat({line(), right}), true));
        else
            right = concat({text(" "), right});
        return concat({std::move(equals), std::move(right), std::move(end)});
    }

    void print(const ast::Horizon& horizon) {
        const auto* condition = std::get_if<ast::Expr>(&horizon.value);
        if (condition == nullptr) return print_line(plain(cursor_, ";"));
        std::vector<Doc> parts;
        for (int i = 0; i < 3; ++i) {  // horizon = terminate-when
            parts.push_back(cursor_.take());
            parts.push_back(text(" "));
        }
        parts.push_back(cursor_.take("("));
        parts.push_back(layout_expression(*condition, cursor_));
        parts.push_back(cursor_.take(")"));
        parts.push_back(semicolon());
        print_line(concat(std::move(parts)));
    }

    Cursor cursor_;
    std::size_t indent_ = 0;
    std::vector<TextLine> lines_;
};

}  // namespace

std::vector<TextLine> layout(const ast::Program& program, std::vector<Token> tokens) {
    return Layout(std::move(tokens)).layout(program);
}

}  // namespace rddlc::format
