// Visits the parts of model expressions.
#pragma once

#include "model/model.hpp"
#include "support/match.hpp"

#include <vector>

namespace rddlc::grounding {

// The direct parts of an expression, in the order written.
inline std::vector<const model::Expr*> parts_of(const model::Expr& expr) {
    std::vector<const model::Expr*> parts;
    const auto add = [&](const model::ExprBox& box) {
        parts.push_back(&*box);
    };
    const auto add_all = [&](const std::vector<model::Expr>& exprs) {
        for (const model::Expr& part : exprs) parts.push_back(&part);
    };
    match(
        expr.node, [&](const model::Reference& form) { add_all(form.arguments); },
        [&](const model::Convert& form) { add(form.operand); },
        [&](const model::Apply& form) { add_all(form.operands); },
        [&](const model::If& form) {
            add(form.condition);
            add(form.then_branch);
            add(form.else_branch);
        },
        [&](const model::Switch& form) {
            add(form.subject);
            for (const auto& value : form.cases) {
                if (value) add(*value);
            }
            if (form.default_case) add(*form.default_case);
        },
        [&](const model::Aggregate& form) { add(form.body); },
        [&](const model::Sample& form) { add_all(form.parameters); },
        [&](const model::Discrete& form) { add_all(form.weights); },
        [&](const model::DiscreteOver& form) { add(form.weight); },
        [&](const model::Determinant& form) { add(form.element); },
        [&](const model::MatrixFunction& form) { add(form.element); },
        [](const auto&) {});  // constants, variables, and what is made of names only
    return parts;
}

// Calls visit(expression) for the whole and all its parts, whole first.
template <class Visit>
void for_each_expression(const model::Expr& expr, const Visit& visit) {
    visit(expr);
    for (const model::Expr* part : parts_of(expr)) for_each_expression(*part, visit);
}

}  // namespace rddlc::grounding
