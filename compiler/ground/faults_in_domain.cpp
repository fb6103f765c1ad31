#include "ground/faults_in_domain.hpp"

#include "ground/ground.hpp"
#include "ground/walk.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rddlc {
namespace {

// Whether it has no part that an instance says: it is made of literals alone.
bool is_closed(const model::Expr& expr) {
    const bool is_made_of_parts = match(
        expr.node, [](const model::Constant&) { return true; },
        [](const model::Convert&) { return true; }, [](const model::Apply&) { return true; },
        [](const model::If&) { return true; }, [](const model::Switch&) { return true; },
        [](const model::Sample&) { return true; }, [](const model::Discrete&) { return true; },
        [](const auto&) { return false; });
    const auto parts = grounding::parts_of(expr);
    return is_made_of_parts &&
           std::ranges::all_of(parts, [](const model::Expr* part) { return is_closed(*part); });
}

// The largest closed parts of an expression, each as a fluent of its own.
void add_closed_parts(const model::Expr& expr, model::Model& model) {
    if (std::holds_alternative<model::Constant>(expr.node)) return;
    if (!is_closed(expr)) {
        for (const model::Expr* part : grounding::parts_of(expr)) add_closed_parts(*part, model);
        return;
    }
    const auto fluent = static_cast<model::FluentId>(model.fluents.size());
    model.fluents.push_back({.name = fmt::format("part-{}", fluent),
                             .role = Role::Interm,
                             .parameters = {},
                             .range = expr.type,
                             .default_value = std::nullopt,
                             .span = expr.span,
                             .values = {}});
    model.cpfs.push_back({fluent, {}, expr, expr.span});
}

// A problem of nothing but these parts, which can be grounded.
model::Model closed_parts_of(const model::Model& domain) {
    model::Model model;
    model.domain_name = domain.domain_name;
    model.types = domain.types;
    model.reward = {model::real_type, domain.reward.span, model::Constant{0.0}};
    for (const model::Cpf& cpf : domain.cpfs) add_closed_parts(cpf.body, model);
    add_closed_parts(domain.reward, model);
    for (const auto* conditions :
         {&domain.action_preconditions, &domain.state_invariants, &domain.terminations})
        for (const model::Expr& condition : *conditions) add_closed_parts(condition, model);
    if (domain.policy)
        for (const model::Cpf& cpf : domain.policy->cpfs) add_closed_parts(cpf.body, model);
    return model;
}

}  // namespace

void warn_of_faults_in_domain(const model::Model& domain, Diagnostics& diagnostics) {
    ground(closed_parts_of(domain), diagnostics);
}

}  // namespace rddlc
