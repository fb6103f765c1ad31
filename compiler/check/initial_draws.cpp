#include "check/initial_draws.hpp"

#include "check/definitions.hpp"
#include "check/expressions.hpp"

#include <fmt/format.h>

#include <utility>

namespace rddlc::checking {
namespace {

bool is_allowed(const ast::Expr& draw, const model::Fluent& fluent, Context& context) {
    if (fluent.role != Role::State) {
        context.report(
            diagnose(wrong_value, draw.span, "only initial values can be random")
                .note(fluent.span, fmt::format("{} '{}'", name_of(fluent.role), fluent.name)));
        return false;
    }
    if (context.standard == Standard::Rddlc) return true;
    context.report(diagnose(extension_needed, draw.span, "initial values cannot be random")
                       .with_hint(std::string(extension_hint)));
    return false;
}

std::vector<std::int64_t> objects_of(const ast::Assignment& assignment, const Context& context) {
    std::vector<std::int64_t> objects;
    for (const ast::Symbol& argument : assignment.arguments)
        objects.push_back(context.names.objects.at(argument.name).index);
    return objects;
}

}  // namespace

const ast::Expr* draw_of(const ast::Assignment& assignment) {
    if (!assignment.value) return nullptr;
    const auto* draw = std::get_if<ast::ExprBox>(&*assignment.value);
    return draw ? &**draw : nullptr;
}

void check_initial_draw(const ast::Assignment& assignment, model::FluentId id,
                        const std::string& grounded_name, Context& context) {
    const ast::Expr& draw = *draw_of(assignment);
    const model::Fluent& fluent = context.fluent(id);
    if (!is_allowed(draw, fluent, context)) return;
    const std::string what = fmt::format("the initial value of '{}'", grounded_name);
    Scope scope{context};
    scope.may_name_objects = true;
    Typed value =
        require(check_expression(draw, scope),
                {fluent.range, what, wrong_value, Note{fluent.span, "declared here"}}, scope);
    check_dependencies(Definition::InitialValue, what, scope.fluent_uses, context);
    if (!value) return;
    context.model.initial_draws.push_back(
        {id, objects_of(assignment, context), std::move(*value), assignment.span});
}

}  // namespace rddlc::checking
