#include "ground/finiteness.hpp"

#include "ground/walk.hpp"
#include "ir/range.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <cmath>

namespace rddlc::grounding {
namespace {

bool has_finite_values(const model::Fluent& fluent) {
    return fluent.values.all_of(rddlc::is_finite);
}

// Of finite values that the instance fixes.
std::optional<ir::Range> range_of(const model::Fluent& fluent) {
    if (fluent.role != Role::NonFluent) return std::nullopt;
    const double common = as_real(fluent.values.common());
    ir::Range range{common, common};
    for (const auto& [index, value] : fluent.values.exceptions())
        range = ir::join(range, {as_real(value), as_real(value)});
    return range;
}

}  // namespace

Finiteness::Finiteness(const model::Model& model) : model_(model) {
    for (const model::Fluent& fluent : model.fluents) {
        fluent_is_finite_.push_back(has_finite_values(fluent));
        ranges_.push_back(fluent_is_finite_.back() ? range_of(fluent) : std::nullopt);
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
        expr.node, [](const model::Constant& form) { return rddlc::is_finite(form.value); },
        [&](const model::Reference& form) -> bool { return fluent_is_finite_[form.fluent]; },
        [&](const model::Apply& form) { return is_finite(form); },
        [&](const model::Aggregate& form) { return is_finite(form); },
        [](const model::External&) { return false; },
        [&](const model::Sample& form) {
            return all_finite(expr) &&
                   ir::draws_finite(form.distribution, ranges_of(form.parameters));
        },
        // Quotients by anything: by what is left of elements by rounding.
        [](const model::MatrixFunction&) { return false; },
        // Parts of 1. The others need a Cholesky factor, with such quotients.
        [](const model::RandomVector& form) {
            return form.distribution == VectorDistribution::Dirichlet;
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
    return ir::keeps_finite(form.op, ranges_of(form.operands));
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

std::vector<std::optional<ir::Range>> Finiteness::ranges_of(
    const std::vector<model::Expr>& operands) const {
    std::vector<std::optional<ir::Range>> ranges;
    for (const model::Expr& operand : operands) ranges.push_back(range_of_value(operand));
    return ranges;
}

// Of constants and non-fluents.
std::optional<ir::Range> Finiteness::range_of_value(const model::Expr& expr) const {
    if (const auto* convert = std::get_if<model::Convert>(&expr.node))
        return range_of_value(*convert->operand);
    if (const auto* constant = std::get_if<model::Constant>(&expr.node))
        return ir::Range{as_real(constant->value), as_real(constant->value)};
    const auto* reference = std::get_if<model::Reference>(&expr.node);
    return reference ? ranges_[reference->fluent] : std::nullopt;
}

}  // namespace rddlc::grounding
