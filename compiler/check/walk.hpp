// The parts of an expression, for passes that look for one thing only.
#pragma once

#include "ast/ast.hpp"
#include "support/match.hpp"

namespace rddlc::checking {

template <class Visit>
void for_each_child(const ast::Expr& e, const Visit& visit) {
    const auto all = [&](const std::vector<ast::Expr>& expressions) {
        for (const ast::Expr& expression : expressions) visit(expression);
    };
    match(
        e.node, [&](const ast::Reference& n) { all(n.arguments); },
        [&](const ast::Group& n) { visit(*n.inner); },
        [&](const ast::Unary& n) { visit(*n.operand); },
        [&](const ast::Binary& n) {
            visit(*n.left);
            visit(*n.right);
        },
        [&](const ast::Aggregation& n) { visit(*n.body); },
        [&](const ast::If& n) {
            visit(*n.condition);
            visit(*n.then_branch);
            visit(*n.else_branch);
        },
        [&](const ast::Switch& n) {
            visit(*n.subject);
            for (const ast::SwitchCase& item : n.cases) visit(*item.value);
        },
        [&](const ast::Call& n) { all(n.arguments); },
        [&](const ast::Distribution& n) { all(n.arguments); },
        [&](const ast::DiscreteCases& n) {
            for (const ast::LabelledWeight& item : n.weights) visit(*item.weight);
        },
        [&](const ast::DiscreteOver& n) { visit(*n.weight); },
        [&](const ast::Determinant& n) { visit(*n.element); },
        [&](const ast::MatrixFunction& n) { visit(*n.element); },
        // No parts that are expressions:
        [](const ast::Boolean&) {}, [](const ast::Integer&) {}, [](const ast::Real&) {},
        [](const ast::Variable&) {}, [](const ast::Literal&) {}, [](const ast::External&) {},
        [](const ast::RandomVector&) {});
}

}  // namespace rddlc::checking
