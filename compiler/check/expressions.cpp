#include "check/expressions.hpp"

#include "support/match.hpp"

#include <fmt/format.h>

namespace rddlc::checking {

namespace {

Typed check_node(const ast::Expr& e, Scope& scope) {
    return match(
        e.node,
        [&](const ast::Boolean& n) -> Typed {
            return model::Expr{model::bool_type, e.span, model::Constant{n.value}};
        },
        [&](const ast::Integer& n) -> Typed {
            return model::Expr{model::int_type, e.span, model::Constant{n.value}};
        },
        [&](const ast::Real& n) -> Typed {
            return model::Expr{model::real_type, e.span, model::Constant{n.value}};
        },
        [&](const ast::Variable& n) { return check_variable(n, e.span, scope); },
        [&](const ast::Literal& n) { return check_literal(n, e.span, scope); },
        [&](const ast::Reference& n) { return check_reference(n, e.span, scope); },
        [&](const ast::Group& n) { return check_expression(*n.inner, scope); },
        [&](const ast::Unary& n) { return check_unary(n, e.span, scope); },
        [&](const ast::Binary& n) { return check_binary(n, e.span, scope); },
        [&](const ast::Aggregation& n) { return check_aggregation(n, e.span, scope); },
        [&](const ast::If& n) { return check_if(n, e.span, scope); },
        [&](const ast::Switch& n) { return check_switch(n, e.span, scope); },
        [&](const ast::Call& n) { return check_call(n, e.span, scope); },
        [&](const ast::Distribution& n) { return check_distribution(n, e.span, scope); },
        [&](const ast::DiscreteCases& n) { return check_discrete(n, e.span, scope); },
        [&](const ast::DiscreteOver& n) { return check_discrete_over(n, e.span, scope); },
        [&](const ast::Determinant& n) { return check_determinant(n, e.span, scope); },
        [&](const ast::MatrixFunction& n) { return check_matrix_function(n, e.span, scope); },
        [&](const ast::External& n) { return check_external(n, e.span, scope); },
        [&](const ast::RandomVector& n) -> Typed {
            scope.context.report(
                {bad_vector, e.span,
                 fmt::format("'{}' can only be the whole right-hand side of a CPF", n.name.text)});
            return std::nullopt;
        });
}

}  // namespace

Typed check_expression(const ast::Expr& e, Scope& scope) {
    scope.path.push_back(&e);
    Typed result = check_node(e, scope);
    scope.path.pop_back();
    return result;
}

const ast::Expr& without_groups(const ast::Expr& expression) {
    const ast::Expr* inner = &expression;
    while (const auto* group = std::get_if<ast::Group>(&inner->node)) inner = &*group->inner;
    return *inner;
}

}  // namespace rddlc::checking
