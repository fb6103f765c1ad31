#include "emit/cpp/print.hpp"

#include "emit/cpp/line_directives.hpp"
#include "emit/cpp/literals.hpp"
#include "support/document.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <iterator>
#include <span>
#include <string_view>
#include <utility>

namespace rddlc::cpp::tree {
namespace {

using document::align;
using document::Doc;
using document::group;
using document::line;
using document::nest;

static_assert(line_width == document::page_width && indentation == document::indentation);

Doc doc(const Expression& expression);
Doc doc(const Statement& statement);

Doc part(Doc doc) {
    return doc;
}
Doc part(std::string text) {
    return document::text(std::move(text));
}

// Docs and texts.
template <class... Parts>
Doc sequence(Parts&&... parts) {
    std::vector<Doc> docs;
    docs.reserve(sizeof...(parts));
    (docs.push_back(part(std::forward<Parts>(parts))), ...);
    return document::concat(std::move(docs));
}

// --------------------------------------------------------------------------- expressions

bool is_lambda(const Expression& expression) {
    return std::holds_alternative<Lambda>(expression.form);
}

bool is_word(const Expression& expression) {
    return std::holds_alternative<Word>(expression.form) ||
           std::holds_alternative<Text>(expression.form);
}

Level level_of(const Expression& expression) {
    if (const auto* word = std::get_if<Word>(&expression.form)) return word->level;
    const auto* operation = std::get_if<Operation>(&expression.form);
    return operation ? operation->op.level : Level::Primary;
}

// The precedence that an operand of `op` needs.
bool needs_parentheses(const Operator& op, Level loosest, const Expression& operand) {
    const Level level = level_of(operand);
    return level < loosest && !(op.associative && level == op.level);
}

// a + b - c: lines are broken behind operators, first behind the last ones that are evaluated.
Doc chain(const Operation& operation) {
    const Operator& op = operation.op;
    const auto operand = [&](const Expression& expression, Level loosest) {
        if (needs_parentheses(op, loosest, expression)) return sequence("(", doc(expression), ")");
        const auto* inner = std::get_if<Operation>(&expression.form);
        return inner && inner->op.level == op.level ? chain(*inner) : doc(expression);
    };
    Doc first = operand(operation.operands.front(), op.left);
    if (operation.operands.size() == 1) return sequence(op.word, std::move(first));
    Doc second = operand(operation.operands.back(), op.right);
    return sequence(std::move(first), " " + op.word, group(sequence(line(), std::move(second))));
}

// The text in pieces that begin behind blanks.
Doc in_quotes(std::string_view text) {
    constexpr std::size_t longest = 85;
    std::vector<Doc> pieces;
    while (text.size() > longest) {
        const std::size_t blank = text.rfind(' ', longest - 1);
        if (blank == text.npos) break;
        pieces.push_back(part(literal(text.substr(0, blank + 1))));
        pieces.push_back(line());
        text.remove_prefix(blank + 1);
    }
    pieces.push_back(part(literal(text)));
    return group(align(document::concat(std::move(pieces))));
}

// Each line holds as many pieces as fit.
Doc filled(std::span<const Expression> items) {
    if (items.size() == 1) return doc(items.front());
    std::vector<Doc> parts;
    for (const Expression& item : items)
        parts.push_back(parts.empty() ? doc(item)
                                      : sequence(",", group(sequence(line(), doc(item)))));
    return document::concat(std::move(parts));
}

// All in one line, or each in a line of its own.
Doc rows(const Bracketed& list) {
    std::vector<Doc> parts;
    for (std::size_t i = 0; i < list.items.size(); ++i) {
        const bool is_last = i + 1 == list.items.size();
        parts.push_back(line(i == 0 ? "" : " "));
        parts.push_back(doc(list.items[i]));
        parts.push_back(is_last ? document::if_broken(",") : part(","));
        if (!list.comments.empty())
            parts.push_back(document::trailing_comment({"// " + list.comments[i]}));
    }
    return group(sequence("{", nest(document::concat(std::move(parts))), line(""), "}"));
}

Doc in_braces(const Bracketed& list) {
    const Expression* only = list.items.size() == 1 ? &list.items.front() : nullptr;
    if (only && std::holds_alternative<Words>(only->form))
        return group(sequence("{", nest(sequence(line(""), doc(*only))), line(""), "}"));
    if (only && list.comments.empty()) return sequence("{", doc(*only), "}");
    if (!list.items.empty() && !is_word(list.items.front())) return rows(list);
    return sequence("{", align(filled(list.items)), "}");
}

Doc arguments(std::span<const Expression> items) {
    const auto lambda = std::ranges::find_if(items, is_lambda);
    const auto before = static_cast<std::size_t>(lambda - items.begin());
    const std::size_t lambdas = items.size() - before;
    if (lambdas == 0) return align(filled(items));
    if (lambdas == 1) {
        if (before == 0) return doc(*lambda);
        Doc first = filled(items.first(before));
        Doc last = doc(*lambda);
        return document::alternatives({sequence(document::flat(first), ", ", last),
                                       nest(sequence(line(""), first, ", ", last))});
    }
    std::vector<Doc> parts = {line("")};
    if (before > 0) parts.push_back(sequence(filled(items.first(before)), ","));
    for (const Expression& each : items.subspan(before))
        parts.push_back(sequence(line(), doc(each), &each == &items.back() ? "" : ","));
    return group(nest(document::concat(std::move(parts))));
}

// Statements in lines of their own, unless they may stand beside their brackets.
Doc in_curly_brackets(Doc head, const Block& body, bool may_be_flat, const char* tail = "}") {
    std::vector<Doc> lines;
    for (const Statement& statement : body) {
        lines.push_back(line());
        lines.push_back(doc(statement));
    }
    return group(
        sequence(std::move(head), "{", nest(document::concat(std::move(lines))), line(), tail),
        !may_be_flat);
}

struct ExpressionPrinter {
    Doc operator()(const Word& word) const { return part(word.text); }
    Doc operator()(const Words& words) const { return document::words(words.texts); }
    Doc operator()(const Text& text) const { return in_quotes(text.characters); }
    Doc operator()(const Bracketed& list) const {
        if (list.brackets == Brackets::Curly) return sequence(doc(*list.head), in_braces(list));
        const auto kind = static_cast<std::size_t>(list.brackets);
        return sequence(doc(*list.head), std::string(1, "([<"[kind]), arguments(list.items),
                        std::string(1, ")]>"[kind]));
    }
    Doc operator()(const Operation& operation) const { return align(chain(operation)); }
    Doc operator()(const Lambda& lambda) const {
        Doc head = part(lambda.captures ? "[&]" : "[]");
        if (!lambda.parameters.empty())
            head = sequence(std::move(head), "(", document::flat(filled(lambda.parameters)), ")");
        const bool only_returns =
            lambda.body.size() == 1 && std::holds_alternative<Return>(lambda.body.front().form);
        return in_curly_brackets(sequence(std::move(head), " "), lambda.body, only_returns,
                                 lambda.is_called ? "}()" : "}");
    }
    Doc operator()(const Declared& declared) const {
        return sequence(declared.type, group(nest(sequence(line(), declared.name))));
    }
};

Doc doc(const Expression& expression) {
    return match(expression.form, ExpressionPrinter{});
}

// The same without a document: expressions are measured far more often than they are printed.
struct Measure {
    std::size_t operator()(const Word& word) const { return word.text.size(); }
    std::size_t operator()(const Bracketed& list) const {
        std::size_t sum = width(*list.head) + 2;
        for (const Expression& item : list.items)
            sum += width(item) + (&item == &list.items.front() ? 0 : 2);  // a comma and a blank
        return sum;
    }
    std::size_t operator()(const Operation& operation) const {
        const auto& [op, operands] = operation;
        std::size_t sum = op.word.size() + 2 * (operands.size() - 1);  // blanks around it
        for (const Expression& operand : operands) {
            const Level loosest = &operand == &operands.front() ? op.left : op.right;
            sum += width(operand) + (needs_parentheses(op, loosest, operand) ? 2 : 0);
        }
        return sum;
    }
    std::size_t operator()(const auto& other) const {
        return document::flat_width(ExpressionPrinter{}(other));
    }
};

// ---------------------------------------------------------------------------- statements

// It breaks lines inside of its brackets rather than before them.
bool has_block(const Expression& expression) {
    const auto* list = std::get_if<Bracketed>(&expression.form);
    return is_lambda(expression) || (list && (list->brackets == Brackets::Curly ||
                                              std::ranges::any_of(list->items, is_lambda)));
}

// The body of a function is printed by add_lines, since its lines may have directives.
struct StatementPrinter {
    Doc operator()(const Expression& expression) const { return sequence(doc(expression), ";"); }
    Doc operator()(const Assign& assign) const {
        Doc head = sequence(doc(assign.target), " =");
        Doc value = sequence(doc(assign.value), ";");
        if (has_block(assign.value)) return sequence(std::move(head), " ", std::move(value));
        return sequence(std::move(head), group(nest(sequence(line(), std::move(value)))));
    }
    Doc operator()(const Return& result) const {
        return sequence("return ", doc(result.value), ";");
    }
    Doc operator()(const If& choice) const {
        return sequence("if (", doc(choice.condition), ") ", doc(*choice.then));
    }
    Doc operator()(const For& loop) const {
        const std::string& name = loop.variable;
        return in_curly_brackets(part("for (rddl::Index " + name + " = 0; " + name + " < " +
                                      loop.size + "; ++" + name + ") "),
                                 loop.body, false);
    }
    Doc operator()(const Function& function) const {
        return sequence(function.attributes + function.result + " " + function.name + "(",
                        align(filled(function.parameters)), function.body.empty() ? ") {}" : ") {");
    }
    Doc operator()(const Record& record) const {
        const std::string head = "struct " + record.name + " ";
        if (record.members.empty()) return part(head + "{};");
        return in_curly_brackets(part(head), record.members, false, "};");
    }
};

Doc doc(const Statement& statement) {
    Doc whole = match(statement.form, StatementPrinter{});
    const bool is_short = std::holds_alternative<Assign>(statement.form);
    if (statement.is_template)
        whole = group(sequence("template <class L>", line(), std::move(whole)), !is_short);
    if (!statement.comment.empty())
        whole = group(sequence("// " + statement.comment, line(), std::move(whole)), true);
    if (!statement.remark.empty())
        whole = sequence(std::move(whole), document::trailing_comment({"// " + statement.remark}));
    return whole;
}

// --------------------------------------------------------------------------------- lines

using Lines = std::vector<document::TextLine>;

// Comments behind neighbouring lines stand under each other.
void align_comments(Lines& lines) {
    const auto has_comment = [](const document::TextLine& each) {
        return !each.comment.empty();
    };
    for (auto begin = lines.begin(); begin != lines.end();) {
        begin = std::find_if(begin, lines.end(), has_comment);
        const auto end = std::find_if_not(begin, lines.end(), has_comment);
        std::size_t column = 0;
        for (auto each = begin; each != end; ++each)
            column = std::max(column, each->text.size() + 2);
        for (; begin != end; ++begin) {
            const bool fits = column + begin->comment.size() <= line_width;
            begin->text.resize(fits ? column : begin->text.size() + 2, ' ');
            begin->text += std::exchange(begin->comment, {});
        }
    }
}

void add_lines(const Statement& statement, std::size_t level, Lines& lines) {
    const std::size_t indent = level * indentation;
    Lines own;
    document::render(doc(statement), std::string(indent, ' '), indent, own);
    for (document::TextLine& each : own) {
        if (!statement.directive.empty()) lines.push_back({statement.directive, ""});
        lines.push_back(std::move(each));
    }
    const auto* function = std::get_if<Function>(&statement.form);
    if (!function || function->body.empty()) return;
    bool has_directive = false;
    for (const Statement& each : function->body) {
        if (has_directive && each.directive.empty()) lines.push_back({line_restorer, ""});
        has_directive = !each.directive.empty();
        add_lines(each, level + 1, lines);
    }
    if (has_directive) lines.push_back({line_restorer, ""});
    lines.push_back({std::string(indent, ' ') + "}", ""});
}

}  // namespace

std::size_t width(const Expression& expression) {
    return match(expression.form, Measure{});
}

std::string print(const Block& definitions, std::size_t level) {
    Lines lines;
    bool is_after_line = true;
    for (const Statement& definition : definitions) {
        Lines next;
        add_lines(definition, level, next);
        const bool is_line = next.size() == 1;
        if (!lines.empty() && !(is_line && is_after_line)) lines.emplace_back();
        is_after_line = is_line;
        std::ranges::move(next, std::back_inserter(lines));
    }
    align_comments(lines);
    std::string result;
    for (const document::TextLine& each : lines) result += each.text + "\n";
    return result;
}

}  // namespace rddlc::cpp::tree
