// Reward, action-preconditions, state-invariants and terminations.
#include "check/definitions.hpp"
#include "check/expressions.hpp"

#include <fmt/format.h>

#include <utility>

namespace rddlc::checking {
namespace {

std::vector<model::Expr> check_all(const ast::Constraints* section, Definition definition,
                                   std::string_view what, Context& context) {
    std::vector<model::Expr> conditions;
    if (!section) return conditions;
    for (const ast::Expr& condition : section->conditions) {
        Scope scope{context};
        Typed checked =
            require_bool(check_expression(condition, scope), fmt::format("a {}", what), scope);
        check_dependencies(definition, fmt::format("a {}", what), scope.fluent_uses, context);
        if (checked) conditions.push_back(std::move(*checked));
    }
    return conditions;
}

}  // namespace

void check_reward(const Blocks& blocks, Context& context) {
    if (!blocks.reward) return;
    Scope scope{context};
    Typed reward = require_real(check_expression(blocks.reward->value, scope), "the reward", scope);
    check_dependencies(Definition::Reward, "the reward", scope.fluent_uses, context);
    if (reward) context.model.reward = std::move(*reward);
}

void check_conditions(const Blocks& blocks, Context& context) {
    context.model.action_preconditions =
        check_all(blocks.action_preconditions, Definition::ActionPrecondition,
                  "precondition of the action", context);
    context.model.state_invariants =
        check_all(blocks.state_invariants, Definition::StateInvariant, "state-invariant", context);
    context.model.terminations =
        check_all(blocks.terminations, Definition::Termination, "termination condition", context);
    const ast::Constraints* unenforced = blocks.state_action_constraints;
    if (unenforced && !unenforced->conditions.empty())
        context.report(diagnose(constraints_not_enforced, blocks.state_action_constraints_span,
                                "'state-action-constraints' are not enforced")
                           .with_hint("write conditions on actions in 'action-preconditions', and "
                                      "those on states in 'state-invariants'"));
}

}  // namespace rddlc::checking
