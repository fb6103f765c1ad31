#include "ground/unsupported.hpp"

#include "ground/codes.hpp"
#include "ground/walk.hpp"
#include "support/match.hpp"

#include <fmt/format.h>

namespace rddlc::grounding {
namespace {

std::string name_of(model::VectorDistribution distribution) {
    switch (distribution) {
        case model::VectorDistribution::MultivariateNormal:
            return "MultivariateNormal";
        case model::VectorDistribution::MultivariateStudent:
            return "MultivariateStudent";
        case model::VectorDistribution::Dirichlet:
            return "Dirichlet";
        case model::VectorDistribution::Multinomial:
            return "Multinomial";
    }
    return {};
}

std::string name_of(model::MatrixOperator op) {
    switch (op) {
        case model::MatrixOperator::Inverse:
            return "inverse";
        case model::MatrixOperator::PseudoInverse:
            return "pinverse";
        case model::MatrixOperator::Cholesky:
            return "cholesky";
    }
    return {};
}

// What of this expression itself is missing; empty if nothing is.
std::string missing(const model::Expr& expr) {
    return match(
        expr.node,
        [](const model::RandomVector& vector) {
            return fmt::format("the random vector '{}'", name_of(vector.distribution));
        },
        [](const model::MatrixFunction& function) {
            return fmt::format("the matrix function '{}'", name_of(function.op));
        },
        [](const model::Determinant&) { return std::string("the matrix function 'det'"); },
        [](const model::External& call) {
            return fmt::format("the external function '${}'", call.function);
        },
        [](const auto&) { return std::string(); });
}

void report(const model::Expr& root, Diagnostics& diagnostics) {
    for_each_expression(root, [&](const model::Expr& expr) {
        const std::string what = missing(expr);
        if (what.empty()) return;
        diagnostics.report(
            {not_supported_yet, expr.span, "valid RDDL, not supported yet: " + what});
    });
}

}  // namespace

void report_unsupported(const model::Model& model, Diagnostics& diagnostics) {
    for (const model::Cpf& cpf : model.cpfs) report(cpf.body, diagnostics);
    report(model.reward, diagnostics);
    for (const auto* conditions :
         {&model.action_preconditions, &model.state_invariants, &model.terminations}) {
        for (const model::Expr& condition : *conditions) report(condition, diagnostics);
    }
}

}  // namespace rddlc::grounding
