#include "ground/finiteness.hpp"

#include "ground/walk.hpp"
#include "ir/range.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <cmath>

namespace rddlc::grounding {
namespace {

double as_real(const model::Value& value) {
    return match(value, [](auto v) { return static_cast<double>(v); });
}

bool has_finite_values(const model::Fluent& fluent) {
    return fluent.values.all_of([](const model::Value& v) { return std::isfinite(as_real(v)); });
}

bool is_small_whole_number(const model::Expr& expr) {
    if (const auto* convert = std::get_if<model::Convert>(&expr.node)) {
        return is_small_whole_number(*convert->operand);
    }
    const auto* constant = std::get_if<model::Constant>(&expr.node);
    if (!constant) return false;
    const double value = as_real(constant->value);
    return value >= 0 && value <= 16 && value == std::floor(value);
}

}  // namespace

Finiteness::Finiteness(const model::Model& model) : model_(model) {
    for (const model::Fluent& fluent : model.fluents) {
        fluent_is_finite_.push_back(has_finite_values(fluent));
    }
    for (const model::InitialDraw& draw : model.initial_draws) {
        if (!is_finite(draw.value)) fluent_is_finite_[draw.fluent] = false;
    }
    while (find_non_finite(model.cpfs) || (model.policy && find_non_finite(model.policy->cpfs))) {
    }
}

bool Finiteness::find_non_finite(const std::vector<model::Cpf>& cpfs) {
    bool found = false;
    for (const model::Cpf& cpf : cpfs) {
        if (!fluent_is_finite_[cpf.fluent] || is_finite(cpf.body)) continue;
        fluent_is_finite_[cpf.fluent] = false;
        found = true;
    }
    return found;
}

bool Finiteness::is_finite(const model::Expr& expr) const {
    if (expr.type != model::real_type) return true;
    return match(
        expr.node, [](const model::Constant& form) { return std::isfinite(as_real(form.value)); },
        [&](const model::Reference& form) -> bool { return fluent_is_finite_[form.fluent]; },
        [&](const model::Apply& form) { return is_finite(form); },
        [&](const model::Aggregate& form) { return is_finite(form); },
        [](const model::External&) { return false; },
        [&](const model::RandomVector& form) {
            return std::ranges::all_of(form.arguments, [&](const model::VectorReference& argument) {
                return fluent_is_finite_[argument.fluent];
            });
        },
        [&](const auto&) { return all_finite(expr); });
}

bool Finiteness::all_finite(const model::Expr& expr) const {
    return std::ranges::all_of(parts_of(expr),
                               [&](const model::Expr* part) { return is_finite(*part); });
}

bool Finiteness::is_finite(const model::Apply& form) const {
    const auto finite = [&](const model::Expr& operand) {
        return is_finite(operand);
    };
    if (!std::ranges::all_of(form.operands, finite)) return false;
    if (form.op == Operator::Divide) return is_never_zero(form.operands.back());
    if (form.op == Operator::Power) return is_small_whole_number(form.operands.back());
    return ir::keeps_finite(form.op);
}

bool Finiteness::is_finite(const model::Aggregate& form) const {
    const auto is_empty = [&](model::VariableId id) {
        return model_.type_of(model_.variables[id]).objects.empty();
    };
    if (form.op == Reduction::Average && std::ranges::any_of(form.variables, is_empty)) {
        return false;
    }
    return is_finite(*form.body);
}

// Constants and non-fluents without a zero.
bool Finiteness::is_never_zero(const model::Expr& expr) const {
    if (const auto* convert = std::get_if<model::Convert>(&expr.node)) {
        return is_never_zero(*convert->operand);
    }
    if (const auto* constant = std::get_if<model::Constant>(&expr.node)) {
        return as_real(constant->value) != 0;
    }
    const auto* reference = std::get_if<model::Reference>(&expr.node);
    if (!reference || model_.fluents[reference->fluent].role != Role::NonFluent) return false;
    return model_.fluents[reference->fluent].values.all_of(
        [](const model::Value& v) { return as_real(v) != 0; });
}

}  // namespace rddlc::grounding
