#include "check/open_ends.hpp"

#include "ast/precedence.hpp"
#include "check/expressions.hpp"
#include "support/match.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace rddlc::checking {
namespace {

using ast::BinaryOperator;

bool contains(Span outer, Span inner) {
    return outer.file == inner.file && outer.begin <= inner.begin && inner.end <= outer.end;
}

bool draws_in(Span span, const Scope& scope) {
    return std::ranges::any_of(scope.draws, [&](Span draw) { return contains(span, draw); });
}

// ------------------------------------------------------------------------- what was written

// A construct that binds variables in a body.
struct OpenConstruct {
    std::string name;  // "sum"
    std::vector<const ast::Name*> variables;
    const ast::Expr* body;
};

std::optional<OpenConstruct> open_construct(const ast::Expr& e) {
    const auto names_of = [](const std::vector<ast::TypedVariable>& variables) {
        std::vector<const ast::Name*> names;
        for (const ast::TypedVariable& typed : variables) names.push_back(&typed.variable);
        return names;
    };
    using Result = std::optional<OpenConstruct>;
    return match(
        e.node,
        [&](const ast::Aggregation& n) -> Result {
            return OpenConstruct{n.op.text, names_of(n.variables), &*n.body};
        },
        [&](const ast::DiscreteOver& n) -> Result {
            return OpenConstruct{n.name.text, names_of(n.variables), &*n.weight};
        },
        [&](const ast::Determinant& n) -> Result {
            return OpenConstruct{"det", {&n.row.variable, &n.column.variable}, &*n.element};
        },
        [](const auto&) -> Result { return std::nullopt; });
}

// The operators on the left edge of a body, those that are applied first before the others.
std::vector<const ast::Binary*> left_edge(const ast::Expr& body) {
    std::vector<const ast::Binary*> operators;
    const ast::Expr* left = &body;
    while (const auto* binary = std::get_if<ast::Binary>(&left->node)) {
        operators.push_back(binary);
        left = &*binary->left;
    }
    std::ranges::reverse(operators);
    return operators;
}

void add_open_edge(const ast::Expr& e, std::vector<const ast::Binary*>& operators);

// The operators that an `if` or another construct at the end of `e` has taken in.
void add_taken_in(const ast::Expr& e, std::vector<const ast::Binary*>& operators) {
    if (const auto* unary = std::get_if<ast::Unary>(&e.node))
        add_taken_in(*unary->operand, operators);
    else if (const auto* binary = std::get_if<ast::Binary>(&e.node))
        add_taken_in(*binary->right, operators);
    else if (const auto* condition = std::get_if<ast::If>(&e.node))
        add_open_edge(*condition->else_branch, operators);
    else if (const auto construct = open_construct(e))
        add_open_edge(*construct->body, operators);
}

void add_open_edge(const ast::Expr& e, std::vector<const ast::Binary*>& operators) {
    const std::vector<const ast::Binary*> left = left_edge(e);
    operators.insert(operators.end(), left.begin(), left.end());
    add_taken_in(e, operators);
}

// The operators before which the body might have ended, in the order of the text.
std::vector<const ast::Binary*> open_edge(const ast::Expr& body) {
    std::vector<const ast::Binary*> operators;
    add_open_edge(body, operators);
    return operators;
}

bool is_comparison(BinaryOperator op) {
    return ast::precedence(op) == ast::precedence(BinaryOperator::Equal);
}

bool begins_with_brackets(const ast::Expr& body) {
    const ast::Expr* first = &body;
    while (const auto* unary = std::get_if<ast::Unary>(&first->node)) first = &*unary->operand;
    return std::holds_alternative<ast::Group>(first->node);
}

// The operators whose right operand ends in the construct that is being checked, from the innermost
// on. What is to the left of an `if` or of another aggregation has no part in it.
std::vector<const ast::Expr*> operators_on_the_left(const Scope& scope) {
    std::vector<const ast::Expr*> operators;
    for (std::size_t i = scope.path.size() - 1; i > 0; --i) {
        const ast::Expr* around = scope.path[i - 1];
        const auto* binary = std::get_if<ast::Binary>(&around->node);
        const bool is_right = binary && &*binary->right == scope.path[i];
        if (!is_right && !std::holds_alternative<ast::Unary>(around->node)) break;
        operators.push_back(around);
    }
    return operators;
}

// -------------------------------------------------------------------------- what it means

// The operators that give the same whether they stand inside or after the construct.
bool is_same_outside(std::optional<Reduction> op, BinaryOperator after) {
    if (!op) return false;
    const bool scales = after == BinaryOperator::Multiply || after == BinaryOperator::Divide;
    const bool shifts = after == BinaryOperator::Add || after == BinaryOperator::Subtract;
    switch (*op) {
        case Reduction::Sum:
            return scales;
        case Reduction::Average:
            return scales || shifts;
        case Reduction::Minimum:
        case Reduction::Maximum:
        case Reduction::ArgMin:
        case Reduction::ArgMax:
            return shifts;
        case Reduction::ForAll:
        case Reduction::Exists:
            return after == BinaryOperator::And || after == BinaryOperator::Or;
        case Reduction::Product:
            break;
    }
    return false;
}

// Whether an operator on the left and one on the right give the same in either order.
bool commute(const ast::Expr& left, BinaryOperator right) {
    const bool scales = right == BinaryOperator::Multiply || right == BinaryOperator::Divide;
    const bool shifts = right == BinaryOperator::Add || right == BinaryOperator::Subtract;
    if (const auto* unary = std::get_if<ast::Unary>(&left.node))
        return unary->op == ast::UnaryOperator::Plus ||
               (unary->op == ast::UnaryOperator::Minus && scales);
    const BinaryOperator op = std::get<ast::Binary>(left.node).op;
    if (op == BinaryOperator::Multiply) return scales;
    if (op == BinaryOperator::Add) return shifts;
    return right == op && (op == BinaryOperator::And || op == BinaryOperator::Or);
}

// Whether an operator on the left would take an operand before one on the right does.
bool goes_first(const ast::Expr& left, BinaryOperator right) {
    const auto* binary = std::get_if<ast::Binary>(&left.node);
    return !binary || ast::precedence(binary->op) >= ast::precedence(right);
}

// Whether the value differs if the operators of `tail` were applied to the whole construct.
bool matters(std::optional<Reduction> op, const std::vector<const ast::Binary*>& tail,
             const std::vector<const ast::Expr*>& left) {
    auto behind = left.begin();  // the operators on the left that would be applied later
    return std::ranges::any_of(tail, [&](const ast::Binary* binary) {
        behind = std::find_if_not(behind, left.end(), [&](const ast::Expr* each) {
            return goes_first(*each, binary->op);
        });
        return !is_same_outside(op, binary->op) ||
               !std::all_of(left.begin(), behind,
                            [&](const ast::Expr* each) { return commute(*each, binary->op); });
    });
}

// ----------------------------------------------------------------------------- in messages

std::string shortened(std::string text, std::size_t longest, std::string instead) {
    return text.size() <= longest ? text : instead;
}

// "sum_{?x : t} "
std::string head_of(const ast::Expr& construct, const OpenConstruct& parts, const Scope& scope) {
    constexpr std::size_t longest = 40;
    const Span head{construct.span.file, construct.span.begin, parts.body->span.begin};
    return shortened(scope.context.sources.text_on_one_line(head), longest, parts.name + "_{...}") +
           " ";
}

// "1.0 / ": what stands to the left of a construct up to the next bracket.
std::string text_before(const ast::Expr& construct, const std::vector<const ast::Expr*>& left,
                        const Scope& scope) {
    constexpr std::size_t longest = 30;
    if (left.empty()) return "";
    const Sources& sources = scope.context.sources;
    const auto* binary = std::get_if<ast::Binary>(&left.front()->node);
    const std::string blank = binary ? " " : "";
    const Span nearest =
        binary ? binary->op_span
               : Span{construct.span.file, left.front()->span.begin, left.front()->span.begin + 1};
    const Span all{construct.span.file, left.back()->span.begin, construct.span.begin};
    return shortened(sources.text_on_one_line(all), longest,
                     fmt::format("... {}", sources.text(nearest))) +
           blank;
}

// The part of the body before an operator.
Span body_before(const OpenConstruct& parts, const ast::Binary& end) {
    return {parts.body->span.file, parts.body->span.begin, end.left->span.end};
}

// The operator and all behind it in the body.
Span body_from(const OpenConstruct& parts, const ast::Binary& end) {
    return {parts.body->span.file, end.op_span.begin, parts.body->span.end};
}

// The brackets that RDDL reads, and those that were probably meant: the body ends before `end`.
std::string both_readings(const ast::Expr& construct, const OpenConstruct& parts,
                          const ast::Binary& end, const std::vector<const ast::Expr*>& left,
                          const Scope& scope) {
    constexpr std::size_t longest = 40;
    const Sources& sources = scope.context.sources;
    const std::string before = text_before(construct, left, scope);
    const std::string head = head_of(construct, parts, scope);
    const std::string group =
        shortened(sources.text_on_one_line(body_before(parts, end)), longest, "[...]");
    const std::string after = shortened(sources.text_on_one_line(body_from(parts, end)), longest,
                                        fmt::format("{} ...", sources.text(end.op_span)));
    return fmt::format("RDDL reads '{0}{1}[{2} {3}]'; '{0}[{1}{2}] {3}' was probably meant", before,
                       head, group, after);
}

// The construct around the one that is being checked that binds `name`.
const ast::Expr* binder_of(const std::string& name, const Scope& scope) {
    const auto around = std::span(scope.path).first(scope.path.size() - 1);
    for (auto each = around.rbegin(); each != around.rend(); ++each) {
        const auto parts = open_construct(**each);
        const bool binds =
            parts && std::ranges::any_of(parts->variables, [&](const auto* variable) {
                return variable->text == name;
            });
        if (binds) return *each;
    }
    return nullptr;
}

std::vector<model::VariableId> ids_of(const OpenConstruct& construct, const Scope& scope) {
    std::vector<model::VariableId> ids;
    for (const Binding& binding : scope.bindings) {
        const bool is_of_it = std::ranges::any_of(
            construct.variables,
            [&](const ast::Name* variable) { return variable->text == binding.name; });
        if (is_of_it && binding.variable) ids.push_back(*binding.variable);
    }
    return ids;
}

// Whether the left operand, which begins the checked `body`, is a bool.
bool is_bool_before(const ast::Binary& end, const model::Expr& body) {
    const Span left = without_groups(*end.left).span;
    const model::Expr* e = &body;
    while (true) {
        const auto* cast = std::get_if<model::Convert>(&e->node);
        if (!cast && e->span == left) return e->type == model::bool_type;
        const auto* apply = std::get_if<model::Apply>(&e->node);
        if (!cast && !apply) return false;
        e = cast ? &*cast->operand : &apply->operands.front();
    }
}

}  // namespace

bool uses_any(Span span, const std::vector<model::VariableId>& variables, const Scope& scope) {
    return std::ranges::any_of(scope.variable_uses, [&](const VariableUse& use) {
        return contains(span, use.span) &&
               std::ranges::find(variables, use.variable) != variables.end();
    });
}

void warn_of_long_body(std::optional<Reduction> op, const std::vector<model::VariableId>& variables,
                       const Scope& scope) {
    const ast::Expr& construct = *scope.path.back();
    const OpenConstruct parts = *open_construct(construct);
    const std::vector<const ast::Binary*> tail = left_edge(*parts.body);
    if (tail.empty() || !begins_with_brackets(*tail.front()->left)) return;
    const Span rest = body_from(parts, *tail.front());
    if (uses_any(rest, variables, scope)) return;
    const std::vector<const ast::Expr*> left = operators_on_the_left(scope);
    if (!matters(op, tail, left) && !draws_in(rest, scope)) return;
    scope.context.report(
        diagnose(
            long_body, rest,
            fmt::format("this belongs to the body of '{}', which extends to the end", parts.name))
            .note(tail.front()->left->span, "the body does not end with these brackets")
            .with_hint(both_readings(construct, parts, *tail.front(), left, scope)));
}

void note_aggregation(const std::vector<model::VariableId>& variables, Scope& scope) {
    scope.aggregations.push_back({scope.path.back(), operators_on_the_left(scope), variables});
}

std::string hint_for_comparison_in_body(Span misfit, const Scope& scope) {
    for (const CheckedAggregation& each : scope.aggregations) {
        const Span span = each.whole->span;
        const Span first = each.left.empty() ? span : each.left.back()->span;
        if (span.end != misfit.end || !contains(misfit, first)) continue;
        const OpenConstruct parts = *open_construct(*each.whole);
        for (const ast::Binary* end : open_edge(*parts.body))
            if (is_comparison(end->op) && !uses_any(body_from(parts, *end), each.variables, scope))
                return both_readings(*each.whole, parts, *end, each.left, scope);
    }
    return "";
}

std::string hint_for_number_as_body(const model::Expr& body, const Scope& scope) {
    const ast::Expr& construct = *scope.path.back();
    const OpenConstruct parts = *open_construct(construct);
    for (const ast::Binary* end : left_edge(*parts.body)) {
        if (!is_bool_before(*end, body)) continue;
        if (uses_any(body_from(parts, *end), ids_of(parts, scope), scope)) continue;
        return both_readings(construct, parts, *end, operators_on_the_left(scope), scope);
    }
    return "";
}

std::string hint_for_compared_object(const Scope& scope) {
    const auto& comparison = std::get<ast::Binary>(scope.path.back()->node);
    const auto around = std::span(scope.path).first(scope.path.size() - 1);
    for (const ast::Expr* each : around) {
        const auto* aggregation = std::get_if<ast::Aggregation>(&each->node);
        const auto op = aggregation ? reduction_named(aggregation->op.text) : std::nullopt;
        if (op != Reduction::ArgMin && op != Reduction::ArgMax) continue;
        const OpenConstruct parts = *open_construct(*each);
        const std::vector<const ast::Binary*> edge = open_edge(*parts.body);
        if (std::ranges::find(edge, &comparison) == edge.end()) continue;
        if (uses_any(body_from(parts, comparison), ids_of(parts, scope), scope)) continue;
        return both_readings(*each, parts, comparison, {}, scope);
    }
    return "";
}

std::string hint_for_bound_again(const std::string& name, const Scope& scope) {
    const ast::Expr* outer = scope.path.empty() ? nullptr : binder_of(name, scope);
    if (!outer) return "use another name";
    const OpenConstruct parts = *open_construct(*outer);
    const Span inner = scope.path.back()->span;
    for (const ast::Binary* end : open_edge(*parts.body)) {
        if (!contains(end->right->span, inner)) continue;
        if (uses_any(body_from(parts, *end), ids_of(parts, scope), scope)) continue;
        constexpr std::size_t longest = 60;
        const std::string body = shortened(
            scope.context.sources.text_on_one_line(body_before(parts, *end)), longest, "[...]");
        return fmt::format(
            "the body of '{}' extends to the end and includes this; to end it before, put brackets "
            "around the whole of it: '[{}{}]'",
            parts.name, head_of(*outer, parts, scope), body);
    }
    return "use another name";
}

}  // namespace rddlc::checking
