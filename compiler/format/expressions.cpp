// Over 400 lines: a function for each kind of expression.
#include "format/expressions.hpp"

#include "ast/precedence.hpp"
#include "support/match.hpp"

#include <algorithm>

namespace rddlc::format {

namespace {

using ast::Expr;

// The operators of a tree's left edge that are of one precedence, from left to right.
std::vector<const ast::Binary*> chain_of(const Expr& expr) {
    std::vector<const ast::Binary*> chain;
    const Expr* left = &expr;
    while (const auto* binary = std::get_if<ast::Binary>(&left->node)) {
        if (!chain.empty() && precedence(binary->op) != precedence(chain.back()->op)) break;
        chain.push_back(binary);
        left = &*binary->left;
    }
    std::reverse(chain.begin(), chain.end());
    return chain;
}

bool is_group(const Expr& expr) {
    return std::holds_alternative<ast::Group>(expr.node);
}

struct Branch {
    Doc head;  // "if (c) then", "else"
    Doc value;
    bool value_begins_line;
};

class ExpressionLayout {
  public:
    explicit ExpressionLayout(Cursor& cursor) : cursor_(cursor) {}

    Doc layout(const Expr& expr) {
        return match(
            expr.node, [&](const ast::Boolean&) { return token(); },
            [&](const ast::Integer&) { return token(); }, [&](const ast::Real&) { return token(); },
            [&](const ast::Variable&) { return token(); },
            [&](const ast::Literal&) { return token(); },
            [&](const ast::Binary&) { return chain(expr); },
            [&](const auto& node) { return layout(node); });
    }

  private:
    // --------------------------------------------------------------------- operators, brackets

    struct Operand {
        Doc op, value;
        bool begins_line;

        Doc behind(Doc space) const { return concat({std::move(space), op, text(" "), value}); }
    };

    std::vector<Operand> operands(const std::vector<const ast::Binary*>& operators) {
        std::vector<Operand> result;
        for (const ast::Binary* binary : operators) {
            bool begins_line = cursor_.next().begins_line();
            Doc op = token();
            begins_line |= cursor_.next().begins_line();
            result.push_back({std::move(op), layout(*binary->right), begins_line});
        }
        return result;
    }

    Doc chain(const Expr& expr) {
        const std::vector<const ast::Binary*> operators = chain_of(expr);
        const Doc first = layout(*operators.front()->left);
        const std::vector<Operand> others = operands(operators);
        const bool is_product =
            precedence(operators.front()->op) == precedence(ast::BinaryOperator::Multiply);
        const Doc in_lines = is_product ? filled(first, others) : one_a_line(first, others);
        const bool broken = std::any_of(others.begin(), others.end(),
                                        [](const Operand& other) { return other.begins_line; });
        if (broken) return in_lines;

        std::vector<Doc> start{first};
        for (const Operand& other : others) start.push_back(other.behind(line()));
        const Doc whole = concat(start);
        start.back() = concat({line(), others.back().op, text(" ")});
        const Doc head = concat(std::move(start));
        const bool may_hug = hugs(*operators.back()->right) && flat_width(head) != unbounded;
        const Doc hugging = concat({flat(head), others.back().value});
        return alternatives({flat(whole), may_hug ? hugging : in_lines, in_lines});
    }

    // A line for each operand.
    static Doc one_a_line(const Doc& first, const std::vector<Operand>& others) {
        std::vector<Doc> parts{first};
        for (const Operand& other : others) parts.push_back(other.behind(line()));
        return align(group(concat(std::move(parts)), true));
    }

    // Fills each line with as many operands as fit.
    static Doc filled(const Doc& first, const std::vector<Operand>& others) {
        std::vector<Doc> parts{first};
        for (const Operand& other : others)
            parts.push_back(group(other.behind(line()), other.begins_line));
        return align(concat(std::move(parts)));
    }

    Doc layout(const ast::Unary& unary) {
        Doc op = token();
        return concat({std::move(op), layout(*unary.operand)});
    }

    Doc layout(const ast::Group& group) {
        Doc open = token();
        Doc inner = layout(*group.inner);
        return concat({std::move(open), std::move(inner), token()});
    }

    // "[ body ]" with the body on lines of its own if need be.
    Doc body_in_brackets(Doc head, const Expr& body) {
        Doc open = token();
        const bool broken = cursor_.next().begins_line();
        Doc inner = layout(body);
        return group(concat({std::move(head), std::move(open), nest(concat({line(""), inner})),
                             if_broken(" "), token()}),
                     broken);
    }

    // ------------------------------------------------------------------------------ arguments

    // "(a, b)"
    template <class Items, class LayoutItem>
    Doc arguments(const Items& items, LayoutItem layout_item) {
        Doc open = token();
        std::vector<Doc> parts;
        for (std::size_t i = 0; i < items.size(); ++i) {
            parts.push_back(layout_item(items[i]));
            if (i + 1 < items.size()) parts.insert(parts.end(), {token(), line()});
        }
        Doc inner = concat(std::move(parts));
        if (items.size() > 1) inner = align(group(inner));
        return concat({std::move(open), std::move(inner), token()});
    }
    Doc arguments(const std::vector<Expr>& exprs) {
        return arguments(exprs, [&](const Expr& expr) { return layout(expr); });
    }
    Doc arguments(const std::vector<ast::VectorReference>& references) {
        return arguments(references,
                         [&](const ast::VectorReference& reference) { return layout(reference); });
    }
    Doc slots(const std::vector<ast::Slot>& list) {
        return arguments(list, [&](const ast::Slot&) { return token(); });
    }

    Doc layout(const ast::Reference& reference) {
        Doc name = token();
        if (!cursor_.is_at("(")) return name;
        return concat({std::move(name), arguments(reference.arguments)});
    }
    Doc layout(const ast::Call& call) {
        Doc name = token();
        return concat({std::move(name), arguments(call.arguments)});
    }
    Doc layout(const ast::Distribution& distribution) {
        Doc name = token();
        return concat({std::move(name), arguments(distribution.arguments)});
    }
    Doc layout(const ast::VectorReference& reference) {
        Doc name = token();
        if (!cursor_.is_at("(")) return name;
        return concat({std::move(name), slots(reference.slots)});
    }
    Doc layout(const ast::RandomVector& vector) {
        Doc name = token();
        Doc axis = slots({vector.axis});
        return concat({std::move(name), std::move(axis), arguments(vector.arguments)});
    }
    Doc layout(const ast::External& external) {
        Doc dollar = token();
        Doc name = token();
        Doc captured = slots(external.captured);
        Doc vectors = cursor_.is_at("(") ? arguments(external.arguments) : text("");
        return concat(
            {std::move(dollar), std::move(name), std::move(captured), std::move(vectors)});
    }

    // ---------------------------------------------------------------------------- aggregations

    // "sum_{?x : t, ?y : u} "
    Doc binder(std::size_t variables) {
        std::vector<Doc> parts;
        for (int i = 0; i < 3; ++i) parts.push_back(token());  // sum _ {
        for (std::size_t i = 0; i < variables; ++i) {
            if (i > 0) parts.insert(parts.end(), {token(), text(" ")});
            parts.push_back(token());
            parts.insert(parts.end(), {text(" "), token(), text(" ")});
            parts.push_back(token());
        }
        parts.insert(parts.end(), {token(), text(" ")});
        return concat(std::move(parts));
    }

    Doc aggregation(std::size_t variables, const Expr& body) {
        Doc head = binder(variables);
        if (is_group(body))
            return body_in_brackets(std::move(head), *std::get<ast::Group>(body.node).inner);
        if (hugs(body)) return concat({std::move(head), layout(body)});
        const bool broken = cursor_.next().begins_line();
        Doc inner = nest(concat({line(""), layout(body)}));
        return group(concat({std::move(head), std::move(inner)}), broken);
    }

    Doc layout(const ast::Aggregation& node) {
        return aggregation(node.variables.size(), *node.body);
    }
    Doc layout(const ast::DiscreteOver& node) {
        return aggregation(node.variables.size(), *node.weight);
    }
    Doc layout(const ast::Determinant& node) { return aggregation(2, *node.element); }

    // "inverse[row = ?r, col = ?c][e]"
    Doc layout(const ast::MatrixFunction& node) {
        std::vector<Doc> head;
        for (int i = 0; i < 2; ++i) head.push_back(token());  // inverse [
        for (int axis = 0; axis < 2; ++axis) {
            if (axis > 0) head.insert(head.end(), {token(), text(" ")});
            head.push_back(token());
            head.insert(head.end(), {text(" "), token(), text(" ")});
            head.push_back(token());
        }
        head.push_back(token());
        return body_in_brackets(concat(std::move(head)), *node.element);
    }

    // ------------------------------------------------------------------------------------- if

    // Choices between two values begin lines with "if", "then" and "else". Longer chains, and those
    // that are so written, have a line for each branch, or two: "else if (c) then" and the value.
    Doc layout(const ast::If& node) {
        Doc head = condition(node);
        bool broken = cursor_.next().begins_line();
        Doc then = token();
        Branch branch{concat({head, text(" "), then}), {}, cursor_.next().begins_line()};
        branch.value = layout(*node.then_branch);
        const Expr* rest = &*node.else_branch;
        if (!branch.value_begins_line && !std::holds_alternative<ast::If>(rest->node))
            return in_three_lines({head, then, branch.value}, *rest, broken);
        return in_branches(std::move(branch), *rest, broken);
    }

    Doc condition(const ast::If& node) {
        Doc keyword = token();
        Doc open = token();
        Doc inner = layout(*node.condition);
        return concat({std::move(keyword), text(" "), std::move(open), std::move(inner), token()});
    }

    struct IfThen {
        Doc head, then, value;
    };
    Doc in_three_lines(const IfThen& first, const Expr& otherwise, bool broken) {
        broken |= cursor_.next().begins_line();
        Doc keyword = token();
        broken |= cursor_.next().begins_line();
        return align(group(concat({first.head, line(), first.then, text(" "), first.value, line(),
                                   std::move(keyword), text(" "), layout(otherwise)}),
                           broken));
    }

    Doc in_branches(Branch first, const Expr& otherwise, bool broken) {
        std::vector<Branch> branches{std::move(first)};
        for (const Expr* rest = &otherwise; rest != nullptr;)
            rest = add_branch(*rest, branches, broken);
        std::vector<Doc> lines;
        for (const Branch& branch : branches) {
            broken |= branch.value_begins_line;
            if (!lines.empty()) lines.push_back(line());
            lines.push_back(group(concat({branch.head, nest(concat({line(), branch.value}))}),
                                  branch.value_begins_line));
        }
        return align(group(concat(std::move(lines)), broken));
    }

    // Returns the next if of the chain, or null.
    const Expr* add_branch(const Expr& rest, std::vector<Branch>& branches, bool& broken) {
        broken |= cursor_.next().begins_line();
        Doc keyword = token();
        const auto* node = std::get_if<ast::If>(&rest.node);
        if (node == nullptr) {
            const bool begins_line = cursor_.next().begins_line();
            branches.push_back({std::move(keyword), layout(rest), begins_line});
            return nullptr;
        }
        broken |= cursor_.next().begins_line();
        Doc head = condition(*node);
        broken |= cursor_.next().begins_line();
        Doc then = token();
        const bool begins_line = cursor_.next().begins_line();
        branches.push_back(
            {concat({std::move(keyword), text(" "), std::move(head), text(" "), std::move(then)}),
             layout(*node->then_branch), begins_line});
        return &*node->else_branch;
    }

    // ------------------------------------------------------------------- switch and Discrete

    struct Case {
        Doc label, colon, value, comma;
    };

    // "label : value," a line each, the colons in one column.
    static Doc in_lines(const std::vector<Case>& cases) {
        constexpr std::size_t widest_column = 24;
        std::size_t column = 0;
        for (const Case& entry : cases)
            if (flat_width(entry.label) <= widest_column)
                column = std::max(column, flat_width(entry.label));
        std::vector<Doc> parts;
        for (const Case& entry : cases) {
            const std::size_t width = std::min(flat_width(entry.label), column);
            if (!parts.empty()) parts.push_back(line());
            parts.insert(parts.end(),
                         {entry.label, if_broken(std::string(column - width, ' ')), text(" "),
                          entry.colon, text(" "), entry.value, entry.comma});
        }
        return concat(std::move(parts));
    }

    // The comma behind an entry, if one follows.
    Doc comma() { return cursor_.is_at(",") ? token() : text(""); }

    Doc layout(const ast::Switch& node) {
        Doc keyword = token();
        Doc open = token();
        Doc subject = layout(*node.subject);
        Doc close = token();
        Doc curly = token();
        const bool broken = cursor_.next().begins_line();
        std::vector<Case> cases;
        for (const ast::SwitchCase& entry : node.cases) cases.push_back(layout(entry));
        Doc head = concat({std::move(keyword), text(" "), std::move(open), std::move(subject),
                           std::move(close), text(" "), std::move(curly)});
        Doc body = nest(concat({line(), in_lines(cases)}));
        return group(concat({std::move(head), std::move(body), line(), token()}), broken);
    }

    Case layout(const ast::SwitchCase& entry) {
        Doc label = token();
        if (entry.label) label = concat({label, text(" "), layout(**entry.label)});
        Doc colon = token();
        Doc value = layout(*entry.value);
        return {std::move(label), std::move(colon), std::move(value), comma()};
    }

    Doc layout(const ast::DiscreteCases& node) {
        std::vector<Doc> head;
        for (int i = 0; i < 4; ++i) head.push_back(token());  // Discrete ( t ,
        const bool broken = cursor_.next().begins_line();
        std::vector<Case> cases;
        for (const ast::LabelledWeight& entry : node.weights) {
            Doc label = token();
            Doc colon = token();
            Doc value = layout(*entry.weight);
            cases.push_back({std::move(label), std::move(colon), std::move(value), comma()});
        }
        Doc body = nest(concat({line(), in_lines(cases)}));
        return group(concat({concat(std::move(head)), std::move(body), token()}), broken);
    }

    Doc token() { return cursor_.take(); }

    Cursor& cursor_;
};

}  // namespace

Doc layout_expression(const ast::Expr& expr, Cursor& cursor) {
    return ExpressionLayout(cursor).layout(expr);
}

bool hugs(const ast::Expr& expr) {
    const auto one_that_hugs = [](const std::vector<ast::Expr>& arguments) {
        return arguments.size() == 1 && hugs(arguments.front());
    };
    const auto is_body = [](const ast::Expr& body) {
        return is_group(body) || hugs(body);
    };
    return match(
        expr.node, [&](const ast::Group& node) { return hugs(*node.inner); },
        [&](const ast::Unary& node) { return hugs(*node.operand); },
        [&](const ast::Binary& node) { return hugs(*node.right); },
        [&](const ast::Aggregation& node) { return is_body(*node.body); },
        [&](const ast::DiscreteOver& node) { return is_body(*node.weight); },
        [&](const ast::Determinant& node) { return is_body(*node.element); },
        [&](const ast::Call& node) { return one_that_hugs(node.arguments); },
        [&](const ast::Distribution& node) { return one_that_hugs(node.arguments); },
        [&](const ast::MatrixFunction&) { return true; }, [&](const ast::Switch&) { return true; },
        [&](const ast::DiscreteCases&) { return true; }, [&](const auto&) { return false; });
}

}  // namespace rddlc::format
