#include "ground/unsupported.hpp"

#include "ground/codes.hpp"
#include "ground/walk.hpp"

#include <fmt/format.h>

namespace rddlc::grounding {
namespace {

void report(const model::Expr& root, Diagnostics& diagnostics) {
    for_each_expression(root, [&](const model::Expr& expr) {
        const auto* call = std::get_if<model::External>(&expr.node);
        if (!call) return;
        diagnostics.report({not_supported_yet, expr.span,
                            fmt::format("valid RDDL, not supported yet: the external function "
                                        "'${}'",
                                        call->function)});
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
