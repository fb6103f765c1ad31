#include "ast/precedence.hpp"
#include "ast/print.hpp"
#include "support/match.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rddlc::ast {

namespace {

// -------------------------------------------------------------------------------- small parts

template <class T, class Print>
std::string list(const std::vector<T>& items, Print print_item) {
    std::string text;
    for (const T& item : items) {
        if (!text.empty()) text += ", ";
        text += print_item(item);
    }
    return text;
}

std::string typed(const TypedVariable& variable) {
    return fmt::format("?{} : {}", variable.variable.text, variable.type.text);
}

std::string slot(const Slot& slot) {
    switch (slot.kind) {
        case Slot::Kind::Variable:
            return "?" + slot.name.text;
        case Slot::Kind::Literal:
            return "@" + slot.name.text;
        case Slot::Kind::Underscore:
            break;
    }
    return "_";
}

std::string vector_reference(const VectorReference& reference) {
    if (reference.slots.empty()) return reference.name.text;
    return fmt::format("{}({})", reference.name.text, list(reference.slots, slot));
}

std::string_view spelling(UnaryOperator op) {
    switch (op) {
        case UnaryOperator::Not:
            return "~";
        case UnaryOperator::Minus:
            return "-";
        case UnaryOperator::Plus:
            break;
    }
    return "+";
}

std::string_view spelling(const Binary& binary) {
    switch (binary.op) {
        case BinaryOperator::Equivalent:
            return "<=>";
        case BinaryOperator::Implies:
            return "=>";
        case BinaryOperator::Or:
            return "|";
        case BinaryOperator::And:
            return binary.ampersand ? "&" : "^";
        case BinaryOperator::Equal:
            return "==";
        case BinaryOperator::NotEqual:
            return "~=";
        case BinaryOperator::Less:
            return "<";
        case BinaryOperator::LessEqual:
            return "<=";
        case BinaryOperator::Greater:
            return ">";
        case BinaryOperator::GreaterEqual:
            return ">=";
        case BinaryOperator::Add:
            return "+";
        case BinaryOperator::Subtract:
            return "-";
        case BinaryOperator::Multiply:
            return "*";
        case BinaryOperator::Divide:
            break;
    }
    return "/";
}

// "sum_{?x : t} " and its like: everything that stands before the body.
std::string binder(const Name& op, const std::vector<TypedVariable>& variables) {
    return fmt::format("{}_{{{}}}", op.text, list(variables, typed));
}

// ----------------------------------------------------------------------------------- one line

// Appends, so that a deep tree is not copied once a level.
class FlatPrinter {
  public:
    void print(const Expr& expr) {
        match(
            expr.node, [&](const Boolean& b) { text_ += b.value ? "true" : "false"; },
            [&](const Integer& i) { text_ += std::to_string(i.value); },
            [&](const Real& r) { text_ += r.text; },
            [&](const Variable& v) { text_.append("?").append(v.name); },
            [&](const Literal& l) { text_.append("@").append(l.name); },
            [&](const auto& node) { print(node); });
    }

    std::string text() && { return std::move(text_); }

  private:
    void print(const Reference& reference) {
        text_.append(reference.name.text).append(reference.primed ? "'" : "");
        if (!reference.arguments.empty()) arguments("(", reference.arguments, ")");
    }

    void print(const Group& group) {
        text_ += group.square ? "[" : "(";
        print(*group.inner);
        text_ += group.square ? "]" : ")";
    }

    void print(const Unary& unary) {
        text_ += spelling(unary.op);
        print(*unary.operand);
    }

    void print(const Binary& binary) {
        print(*binary.left);
        text_.append(" ").append(spelling(binary)).append(" ");
        print(*binary.right);
    }

    void print(const Aggregation& aggregation) {
        text_.append(binder(aggregation.op, aggregation.variables)).append(" ");
        print(*aggregation.body);
    }

    void print(const If& node) {
        text_ += "if (";
        print(*node.condition);
        text_ += ") then ";
        print(*node.then_branch);
        text_ += " else ";
        print(*node.else_branch);
    }

    void print(const Switch& node) {
        text_ += "switch (";
        print(*node.subject);
        text_ += ") { ";
        bool first = true;
        for (const SwitchCase& entry : node.cases) {
            if (!std::exchange(first, false)) text_ += ", ";
            print(entry);
        }
        text_ += " }";
    }

    void print(const SwitchCase& entry) {
        text_ += entry.label ? "case " : "default";
        if (entry.label) print(**entry.label);
        text_ += " : ";
        print(*entry.value);
    }

    void print(const Call& call) {
        text_ += call.function.text;
        arguments("[", call.arguments, "]");
    }

    void print(const Distribution& distribution) {
        text_ += distribution.name.text;
        arguments("(", distribution.arguments, ")");
    }

    void print(const DiscreteCases& discrete) {
        text_.append(discrete.name.text).append("(").append(discrete.type.text);
        for (const LabelledWeight& entry : discrete.weights) {
            text_.append(entry.at_sign ? ", @" : ", ").append(entry.label.text).append(" : ");
            print(*entry.weight);
        }
        text_ += ")";
    }

    void print(const DiscreteOver& discrete) {
        text_.append(binder(discrete.name, discrete.variables)).append(" ");
        print(*discrete.weight);
    }

    void print(const Determinant& determinant) {
        text_ += fmt::format("det_{{{}, {}}} ", typed(determinant.row), typed(determinant.column));
        print(*determinant.element);
    }

    void print(const MatrixFunction& function) {
        text_ += fmt::format("{}[row = ?{}, col = ?{}][", function.name.text, function.row.text,
                             function.column.text);
        print(*function.element);
        text_ += "]";
    }

    void print(const External& external) {
        text_ += fmt::format("${}[{}]", external.function.text, list(external.captured, slot));
        if (!external.arguments.empty())
            text_ += fmt::format("({})", list(external.arguments, vector_reference));
    }

    void print(const RandomVector& vector) {
        text_ += fmt::format("{}[{}]({})", vector.name.text, slot(vector.axis),
                             list(vector.arguments, vector_reference));
    }

    void arguments(std::string_view open, const std::vector<Expr>& arguments,
                   std::string_view close) {
        text_ += open;
        bool first = true;
        for (const Expr& argument : arguments) {
            if (!std::exchange(first, false)) text_ += ", ";
            print(argument);
        }
        text_ += close;
    }

    std::string text_;
};

// --------------------------------------------------------------------------------- many lines

// "first\n    rest\n    rest"
std::string hanging(std::string_view text) {
    std::string result;
    std::size_t begin = 0;
    for (std::size_t end; (end = text.find('\n', begin)) != text.npos; begin = end + 1)
        result.append(text, begin, end + 1 - begin).append("    ");
    return result.append(text, begin);
}

// Constructs that end in a body or hold one in brackets put it on lines of its own; operators
// begin a line. Everything else stays on one line, however long.
class WrappingPrinter {
  public:
    explicit WrappingPrinter(std::size_t width) : width_(width) {}

    std::string print(const Expr& expr) const {
        std::string flat = ast::print(expr);
        if (flat.size() <= width_) return flat;
        return match(
            expr.node, [&](const Group& group) { return print(group); },
            [&](const Binary&) { return print_chain(expr); },
            [&](const Aggregation& a) { return body(binder(a.op, a.variables), *a.body); },
            [&](const DiscreteOver& d) { return body(binder(d.name, d.variables), *d.weight); },
            [&](const If& node) { return print(node); },
            [&](const Switch& node) { return print(node); },
            [&](const DiscreteCases& discrete) { return print(discrete); },
            [&](const auto&) { return std::move(flat); });
    }

  private:
    std::string print(const Group& group) const {
        return fmt::format("{}{}{}", group.square ? "[" : "(", hanging(print(*group.inner)),
                           group.square ? "]" : ")");
    }

    // The operands of a chain of operators of one precedence, a line each.
    std::string print_chain(const Expr& expr) const {
        std::vector<const Binary*> chain;
        const Expr* leftmost = &expr;
        while (const auto* binary = std::get_if<Binary>(&leftmost->node)) {
            if (!chain.empty() && precedence(binary->op) != precedence(chain.back()->op)) break;
            chain.push_back(binary);
            leftmost = &*binary->left;
        }
        std::reverse(chain.begin(), chain.end());
        std::string text = print(*leftmost);
        for (const Binary* binary : chain)
            text += fmt::format("\n{} {}", spelling(*binary), hanging(print(*binary->right)));
        return text;
    }

    std::string body(std::string_view head, const Expr& inner) const {
        return fmt::format("{}\n    {}", head, hanging(print(inner)));
    }

    // An "else if" continues in the same column.
    std::string print(const If& first) const {
        std::string text;
        const If* node = &first;
        while (true) {
            text += fmt::format("if ({})\nthen {}\nelse ", hanging(print(*node->condition)),
                                hanging(print(*node->then_branch)));
            const If* next = std::get_if<If>(&node->else_branch->node);
            if (next == nullptr) return text + hanging(print(*node->else_branch));
            node = next;
        }
    }

    std::string print(const Switch& node) const {
        std::string text = fmt::format("switch ({}) {{", hanging(print(*node.subject)));
        bool first = true;
        for (const SwitchCase& entry : node.cases) {
            text += std::exchange(first, false) ? "\n    " : ",\n    ";
            text += entry.label ? "case " + ast::print(**entry.label) : "default";
            text += " : " + hanging(hanging(print(*entry.value)));
        }
        return text + "\n}";
    }

    std::string print(const DiscreteCases& discrete) const {
        std::string text = fmt::format("{}({}", discrete.name.text, discrete.type.text);
        for (const LabelledWeight& entry : discrete.weights)
            text += fmt::format(",\n    {}{} : {}", entry.at_sign ? "@" : "", entry.label.text,
                                hanging(hanging(print(*entry.weight))));
        return text + ")";
    }

    std::size_t width_;
};

}  // namespace

std::string print(const Expr& expr) {
    FlatPrinter printer;
    printer.print(expr);
    return std::move(printer).text();
}

std::string print_wrapped(const Expr& expr, std::size_t width) {
    return WrappingPrinter(width).print(expr);
}

}  // namespace rddlc::ast
