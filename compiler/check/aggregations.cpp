// Constructs that bind variables: aggregations, distributions over objects, determinants.
#include "check/expressions.hpp"
#include "check/open_ends.hpp"
#include "check/types.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rddlc::checking {
namespace {

bool is_arg_reduction(Reduction op) {
    return op == Reduction::ArgMin || op == Reduction::ArgMax;
}

// Reductions without a value over an empty type.
bool needs_objects(Reduction op) {
    return is_arg_reduction(op) || op == Reduction::Minimum || op == Reduction::Maximum;
}

bool check_nonempty(const std::vector<model::VariableId>& variables, const ast::Name& name,
                    Context& context) {
    for (const model::VariableId id : variables) {
        const model::Type& type = context.model.type_of(context.model.variables[id]);
        const bool is_open = context.names.open_types.contains(context.model.variables[id].type);
        if (is_open || !type.objects.empty()) continue;
        if (!context.names.broken_types.contains(context.model.variables[id].type))
            context.report(diagnose(empty_scope, name.span,
                                    fmt::format("'{}' has no value over the empty type '{}'",
                                                name.text, type.name))
                               .note(type.span, "declared here"));
        return false;
    }
    return true;
}

bool check_single(std::size_t variables, const ast::Name& name, Context& context) {
    if (variables == 1) return true;
    context.report({one_variable_needed, name.span,
                    fmt::format("'{}' takes one variable, found {}", name.text, variables)});
    return false;
}

bool is_number(const ast::Expr& e) {
    return std::holds_alternative<ast::Integer>(e.node) ||
           std::holds_alternative<ast::Real>(e.node);
}

// `sum_{?o : t} 1` counts objects on purpose.
void warn_of_unused_variables(const std::vector<model::VariableId>& variables,
                              const ast::Expr& body, std::string_view what, Scope& scope) {
    if (is_number(without_groups(body))) return;
    for (const model::VariableId id : variables) {
        if (uses_any(body.span, {id}, scope)) continue;
        const model::Variable& variable = scope.context.model.variables[id];
        scope.context.report(
            {unused_variable, variable.span,
             fmt::format("the body of '{}' does not use '?{}'", what, variable.name)});
    }
}

Typed check_body(Reduction op, Typed body, const ast::Name& name, Scope& scope) {
    const std::string what = fmt::format("the body of '{}'", name.text);
    if (is_quantifier(op)) {
        Need need{model::bool_type, what, bool_needed};
        if (body && body->type != need.type) need.hint = hint_for_number_as_body(*body, scope);
        return require(std::move(body), need, scope);
    }
    if (op == Reduction::Average) return require_real(std::move(body), what, scope);
    body = require_number(std::move(body), what, scope);
    if (!body) return std::nullopt;
    const model::ValueType type = promoted(model::int_type, body->type);
    return convert(std::move(*body), type);
}

void report_unknown_aggregation(const ast::Name& name, Context& context) {
    Hint hint = suggestion(context, name.text, name.span, reduction_names);
    if (function_named(name.text) && !reduction_named(name.text))
        hint = fmt::format("'{0}' is a function: '{0}[...]'", name.text);
    context.report(diagnose(unknown_aggregation, name.span,
                            fmt::format("there is no aggregation '{}'", name.text))
                       .with_hint(hint));
}

}  // namespace

Typed check_aggregation(const ast::Aggregation& aggregation, Span span, Scope& scope) {
    Context& context = scope.context;
    const ast::Name& name = aggregation.op;
    const std::optional<Reduction> op = reduction_named(name.text);
    if (!op) report_unknown_aggregation(name, context);

    const Binder binder(aggregation.variables, name.text, span, scope);
    Typed body = check_expression(*aggregation.body, scope);
    if (!op) return std::nullopt;
    body = check_body(*op, std::move(body), name, scope);
    const bool single =
        !is_arg_reduction(*op) || check_single(aggregation.variables.size(), name, context);
    const auto variables = binder.variables();
    if (!body || !variables || !single) return std::nullopt;
    if (needs_objects(*op) && !check_nonempty(*variables, name, context)) return std::nullopt;
    note_aggregation(*variables, scope);
    warn_of_long_body(*op, *variables, scope);
    warn_of_unused_variables(*variables, *aggregation.body, name.text, scope);

    model::ValueType type = body->type;
    if (is_arg_reduction(*op))
        type = {model::ValueType::Kind::Object, context.model.variables[variables->front()].type};
    return model::Expr{type, span, model::Aggregate{*op, *variables, std::move(*body)}};
}

Typed check_discrete_over(const ast::DiscreteOver& discrete, Span span, Scope& scope) {
    Context& context = scope.context;
    scope.draws.push_back(span);
    const Binder binder(discrete.variables, discrete.name.text, span, scope);
    Typed weight = require_real(check_expression(*discrete.weight, scope),
                                fmt::format("the weight of '{}'", discrete.name.text), scope);
    const bool single = check_single(discrete.variables.size(), discrete.name, context);
    const auto variables = binder.variables();
    if (!weight || !variables || !single) return std::nullopt;
    if (!check_nonempty(*variables, discrete.name, context)) return std::nullopt;
    const model::VariableId variable = variables->front();
    const model::ValueType type{model::ValueType::Kind::Object,
                                context.model.variables[variable].type};
    return model::Expr{
        type, span,
        model::DiscreteOver{discrete.name.text == "UnnormDiscrete", variable, std::move(*weight)}};
}

Typed check_determinant(const ast::Determinant& determinant, Span span, Scope& scope) {
    Context& context = scope.context;
    const Binder binder({determinant.row, determinant.column}, "det", span, scope);
    Typed element =
        require_real(check_expression(*determinant.element, scope), "the body of 'det'", scope);
    const auto variables = binder.variables();
    if (!element || !variables) return std::nullopt;
    const model::VariableId row = variables->front();
    const model::VariableId column = variables->back();
    if (!check_square("det", row, column, span, context)) return std::nullopt;
    warn_of_long_body({}, *variables, scope);
    return model::Expr{model::real_type, span,
                       model::Determinant{row, column, std::move(*element)}};
}

}  // namespace rddlc::checking
