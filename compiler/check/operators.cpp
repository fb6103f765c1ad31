// Unary and binary operators.
#include "check/expressions.hpp"
#include "check/open_ends.hpp"
#include "check/types.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace rddlc::checking {
namespace {

Operator operator_of(ast::BinaryOperator op) {
    switch (op) {
        case ast::BinaryOperator::Equivalent:
            return Operator::Equivalent;
        case ast::BinaryOperator::Implies:
            return Operator::Implies;
        case ast::BinaryOperator::Or:
            return Operator::Or;
        case ast::BinaryOperator::And:
            return Operator::And;
        case ast::BinaryOperator::Equal:
            return Operator::Equal;
        case ast::BinaryOperator::NotEqual:
            return Operator::NotEqual;
        case ast::BinaryOperator::Less:
            return Operator::Less;
        case ast::BinaryOperator::LessEqual:
            return Operator::LessEqual;
        case ast::BinaryOperator::Greater:
            return Operator::Greater;
        case ast::BinaryOperator::GreaterEqual:
            return Operator::GreaterEqual;
        case ast::BinaryOperator::Add:
            return Operator::Add;
        case ast::BinaryOperator::Subtract:
            return Operator::Subtract;
        case ast::BinaryOperator::Multiply:
            return Operator::Multiply;
        case ast::BinaryOperator::Divide:
            break;
    }
    return Operator::Divide;
}

struct BinaryPlace {
    Operator op;
    Span span;  // of the whole
    Span op_span;
    const ast::Expr &left, &right;

    std::string left_operand() const {
        return fmt::format("the left operand of '{}'", source_name_of(op));
    }
    std::string right_operand() const {
        return fmt::format("the right operand of '{}'", source_name_of(op));
    }
};

model::Expr apply(Operator op, model::Expr left, model::Expr right, model::ValueType type,
                  Span span) {
    model::Apply node{op, {}};
    node.operands.reserve(2);
    node.operands.push_back(std::move(left));
    node.operands.push_back(std::move(right));
    return {type, span, std::move(node)};
}

// Both operands converted to `operand_type`.
model::Expr apply_converted(Operator op, model::Expr left, model::Expr right,
                            model::ValueType operand_type, model::ValueType type, Span span) {
    return apply(op, convert(std::move(left), operand_type),
                 convert(std::move(right), operand_type), type, span);
}

Typed check_arithmetic(const BinaryPlace& place, Typed left, Typed right, Scope& scope) {
    left = require_number(std::move(left), place.left_operand(), scope);
    right = require_number(std::move(right), place.right_operand(), scope);
    if (!left || !right) return std::nullopt;
    model::ValueType type = promoted(model::int_type, promoted(left->type, right->type));
    if (place.op == Operator::Divide) type = model::real_type;
    return apply_converted(place.op, std::move(*left), std::move(*right), type, type, place.span);
}

// One of its own, not one in parentheses.
bool is_comparison(const ast::Expr& expression) {
    const auto* binary = std::get_if<ast::Binary>(&expression.node);
    if (!binary) return false;
    const Operator op = operator_of(binary->op);
    return is_order(op) || op == Operator::Equal || op == Operator::NotEqual;
}

// a < b < c, and 1 == n == 2; 'a == b == c' of bools may well be meant.
bool compares_truth(const BinaryPlace& place, model::ValueType right) {
    const bool is_of_number = right == model::int_type || right == model::real_type;
    return is_comparison(place.left) && !is_comparison(place.right) &&
           (is_order(place.op) || is_of_number);
}

Typed check_comparison(const BinaryPlace& place, Typed left, Typed right, Scope& scope) {
    if (!left || !right) return std::nullopt;
    const bool objects = is_object(left->type) || is_object(right->type);
    if (objects && left->type != right->type) {
        scope.context.report(
            diagnose(not_comparable, place.op_span,
                     fmt::format("cannot compare {} with {}", describe(scope.context, left->type),
                                 describe(scope.context, right->type)))
                .with_hint(hint_for_compared_object(scope)));
        return std::nullopt;
    }
    if (objects && is_order(place.op)) {
        scope.context.report(diagnose(not_comparable, place.op_span,
                                      fmt::format("objects have no order: '{}' compares numbers",
                                                  source_name_of(place.op)))
                                 .with_hint("only '==' and '~=' compare objects"));
        return std::nullopt;
    }
    if (compares_truth(place, right->type))
        scope.context.report(diagnose(compared_comparison, place.span,
                                      fmt::format("this compares the truth of the left comparison, "
                                                  "0 or 1, with the right side of '{}'",
                                                  source_name_of(place.op)))
                                 .with_hint("a range is written 'a < b ^ b < c'; parentheses "
                                            "around the left comparison silence this"));
    model::ValueType type = objects ? left->type : promoted(left->type, right->type);
    if (is_order(place.op) && type == model::bool_type) type = model::int_type;
    return apply_converted(place.op, std::move(*left), std::move(*right), type, model::bool_type,
                           place.span);
}

bool is_constant(const ast::Expr& expression) {
    return std::holds_alternative<ast::Boolean>(expression.node) ||
           std::holds_alternative<ast::Integer>(expression.node) ||
           std::holds_alternative<ast::Real>(expression.node);
}

// Decides which operand of '^' and '|' is evaluated first: the right one if it is a literal or a
// plain reference, otherwise the left one. The other may be skipped, so its type may be wrong as
// long as that happens.
bool right_goes_first(const ast::Expr& right) {
    const ast::Expr& inner = without_groups(right);
    return is_constant(inner) || std::holds_alternative<ast::Reference>(inner.node) ||
           std::holds_alternative<ast::Variable>(inner.node) ||
           std::holds_alternative<ast::Literal>(inner.node);
}

// A literal that never settles the outcome: then the other operand is always evaluated.
bool never_settles(Operator op, const model::Expr& first) {
    const auto* constant = std::get_if<model::Constant>(&first.node);
    return constant && constant->value == model::Value{op == Operator::And};
}

bool is_arithmetic(Operator op) {
    return op == Operator::Add || op == Operator::Subtract || op == Operator::Multiply ||
           op == Operator::Divide;
}

constexpr const char* power_hint = "'^' is 'and'; a power is written 'pow[x, y]'";

bool is_literal_number(const ast::Expr& expression) {
    return std::holds_alternative<ast::Integer>(expression.node) ||
           std::holds_alternative<ast::Real>(expression.node);
}

// The expression directly behind an operator that has this right side: the x of x * 2 > y.
const ast::Expr& leftmost(const ast::Expr& expression) {
    const auto* binary = std::get_if<ast::Binary>(&without_groups(expression).node);
    return binary ? leftmost(*binary->left) : without_groups(expression);
}

// x ^ 2, x ^ 2 + y, x ^ 2 > y, or x ^ y * z.
bool is_meant_as_power(const BinaryPlace& place) {
    if (place.op != Operator::And) return false;
    const auto* binary = std::get_if<ast::Binary>(&without_groups(place.right).node);
    return is_literal_number(leftmost(place.right)) ||
           (binary && is_arithmetic(operator_of(binary->op)));
}

// The change is pow[x, 2] for x ^ 2. In a + x ^ 2 > b the parts on both sides are not those of '^'.
Hint hint_for_power(const BinaryPlace& place, const Context& context) {
    const bool is_one_term = !std::holds_alternative<ast::Binary>(place.left.node) &&
                             !std::holds_alternative<ast::Unary>(place.left.node);
    if (!is_one_term || !is_literal_number(without_groups(place.right))) return power_hint;
    return {power_hint,
            {{place.span, fmt::format("pow[{}, {}]", context.sources.text(place.left.span),
                                      context.sources.text(place.right.span))}}};
}

// 'a ^ 2.0 > 1.0' is about bools, but a comparison of literals suggests another meaning.
void warn_of_compared_literals(const BinaryPlace& place, Context& context) {
    const ast::Expr& inner = without_groups(place.right);
    const auto* binary = std::get_if<ast::Binary>(&inner.node);
    if (place.op != Operator::And || !is_comparison(inner)) return;
    if (!is_literal_number(without_groups(*binary->left)) ||
        !is_literal_number(without_groups(*binary->right)))
        return;
    context.report(
        diagnose(compared_literals, inner.span,
                 "both sides of this comparison are literals, so the result never changes")
            .with_hint(power_hint));
}

Typed check_lazy_logic(const BinaryPlace& place, Typed left, Typed right, Scope& scope) {
    if (left && left->type == model::bool_type) warn_of_compared_literals(place, scope.context);
    const std::string hint = is_meant_as_power(place) ? power_hint : "";
    const auto is_int_or_real = [](const Typed& operand) {
        return operand && (operand->type == model::int_type || operand->type == model::real_type);
    };
    if (!hint.empty() && is_int_or_real(left) && is_int_or_real(right)) {
        scope.context.report(diagnose(bool_needed, place.op_span, "'^' joins bools, found numbers")
                                 .with_hint(hint_for_power(place, scope.context)));
        return std::nullopt;
    }
    const bool swap = right_goes_first(place.right);
    left = require_number(std::move(left), place.left_operand(), scope);
    right = require_number(std::move(right), place.right_operand(), scope);
    Typed& first = swap ? right : left;
    Typed& second = swap ? left : right;
    std::string first_name = swap ? place.right_operand() : place.left_operand();
    std::string second_name = swap ? place.left_operand() : place.right_operand();
    const Need first_need{model::bool_type, std::move(first_name), bool_needed, {}, hint};
    const Need second_need{model::bool_type, std::move(second_name), bool_needed, {}, hint};
    first = require(std::move(first), first_need, scope);
    const bool second_is_bool = second && second->type == model::bool_type;
    const bool may_be_skipped = first && !never_settles(place.op, *first);
    if (second_is_bool || !may_be_skipped) {
        second = require(std::move(second), second_need, scope);
        if (!left || !right) return std::nullopt;
        return apply(place.op, std::move(*left), std::move(*right), model::bool_type, place.span);
    }
    if (!second) return std::nullopt;
    const model::Expr misfit = *second;
    Typed narrowed = try_require(std::move(*second), second_need, scope);
    if (!narrowed) narrowed = fault_instead_of(misfit, second_need, scope);
    return apply(place.op, std::move(*first), std::move(*narrowed), model::bool_type, place.span);
}

Typed check_strict_logic(const BinaryPlace& place, Typed left, Typed right, Scope& scope) {
    left = require_bool(std::move(left), place.left_operand(), scope);
    right = require_bool(std::move(right), place.right_operand(), scope);
    if (!left || !right) return std::nullopt;
    return apply(place.op, std::move(*left), std::move(*right), model::bool_type, place.span);
}

Typed combine(const BinaryPlace& place, Typed left, Typed right, Scope& scope) {
    if (is_comparison(place.op))
        return check_comparison(place, std::move(left), std::move(right), scope);
    if (typing_of(place.op) != Typing::Logic)
        return check_arithmetic(place, std::move(left), std::move(right), scope);
    if (is_one_of(place.op, {Operator::And, Operator::Or}))
        return check_lazy_logic(place, std::move(left), std::move(right), scope);
    return check_strict_logic(place, std::move(left), std::move(right), scope);
}

Typed check_sign(Operator op, const ast::Unary& unary, Span span, Scope& scope) {
    Typed operand = require_number(check_expression(*unary.operand, scope),
                                   fmt::format("the operand of '{}'", source_name_of(op)), scope);
    if (!operand) return std::nullopt;
    const model::ValueType type = promoted(model::int_type, operand->type);
    model::Expr number = convert(std::move(*operand), type);
    if (op == Operator::Add) return number;  // unary plus
    return model::Expr{type, span, model::Apply{op, {std::move(number)}}};
}

}  // namespace

Typed check_unary(const ast::Unary& unary, Span span, Scope& scope) {
    if (unary.op == ast::UnaryOperator::Minus)
        return check_sign(Operator::Negate, unary, span, scope);
    if (unary.op == ast::UnaryOperator::Plus) return check_sign(Operator::Add, unary, span, scope);
    Typed operand =
        require_bool(check_expression(*unary.operand, scope), "the operand of '~'", scope);
    if (!operand) return std::nullopt;
    return model::Expr{model::bool_type, span, model::Apply{Operator::Not, {std::move(*operand)}}};
}

Typed check_binary(const ast::Binary& binary, Span span, Scope& scope) {
    const BinaryPlace place{operator_of(binary.op), span, binary.op_span, *binary.left,
                            *binary.right};
    Typed left = check_expression(*binary.left, scope);
    Typed right = check_expression(*binary.right, scope);
    return combine(place, std::move(left), std::move(right), scope);
}

}  // namespace rddlc::checking
