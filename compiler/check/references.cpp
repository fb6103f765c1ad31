// Variables, literals and references to fluents.
#include "check/expressions.hpp"
#include "check/names.hpp"
#include "check/types.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace rddlc::checking {
namespace {

model::ValueType object_type(model::TypeId type) {
    return {model::ValueType::Kind::Object, type};
}

// An object is named in the domain; only members of enumerated types may be.
Typed check_object(const std::string& name, const Object& object, Span span, Scope& scope) {
    const model::Type& type = scope.context.type(object.type);
    if (!type.enumerated && !scope.may_name_objects) {
        const bool of_policy = scope.context.model.policy.has_value();
        scope.context.report(
            diagnose(object_in_domain, span,
                     fmt::format("'{}' is an object of the instance: {} cannot name it", name,
                                 of_policy ? "a policy's CPFs" : "the domain"))
                .note(object.span, fmt::format("object of type '{}'", type.name))
                .with_hint(of_policy
                               ? fmt::format("declare a non-fluent of the policy for it, as "
                                             "in THE-ONE : {{ non-fluent, {}, default = {} }};",
                                             type.name, name)
                               : "use a variable, or a non-fluent that the instance sets for "
                                 "this object"));
        return std::nullopt;
    }
    return model::Expr{object_type(object.type), span, model::Constant{object.index}};
}

// "(res, time)", or nothing for a fluent without parameters.
std::string parameter_list(const model::Fluent& fluent, const Context& context) {
    std::vector<std::string> types;
    for (const model::TypeId type : fluent.parameters) types.push_back(context.type(type).name);
    return types.empty() ? "" : fmt::format(" ({})", fmt::join(types, ", "));
}

bool check_arity(const model::Fluent& fluent, std::size_t found, Span span, Context& context) {
    const std::size_t expected = fluent.parameters.size();
    if (found == expected) return true;
    context.report(
        diagnose(wrong_arity, span,
                 fmt::format("'{}' takes {}{}, found {}", fluent.name,
                             counted(expected, "argument"), parameter_list(fluent, context), found))
            .note(fluent.span, "declared here"));
    return false;
}

bool check_prime(const ast::Reference& reference, const model::Fluent& fluent, Context& context) {
    if (!reference.primed || fluent.role == Role::State) return true;
    context.report(diagnose(misplaced_prime, reference.name.span,
                            fmt::format("'{}' is {}: only state-fluents have a next value",
                                        fluent.name, with_article(fluent.role)))
                       .note(fluent.span, "declared here")
                       .with_hint({fmt::format("write '{}' without the prime", fluent.name),
                                   {{last_character(reference.name.span), ""}}}));
    return false;
}

std::optional<std::vector<model::Expr>> check_arguments(const ast::Reference& reference,
                                                        const model::Fluent& fluent, Scope& scope) {
    std::vector<model::Expr> arguments;
    bool sound = true;
    for (std::size_t i = 0; i < reference.arguments.size(); ++i) {
        const Need need{
            object_type(fluent.parameters[i]),
            fmt::format("argument {} of '{}'", i + 1, fluent.name),
            wrong_argument_type,
            Note{fluent.span, "declared here"},
        };
        Typed argument = require(check_expression(reference.arguments[i], scope), need, scope);
        sound = sound && argument.has_value();
        if (argument) arguments.push_back(std::move(*argument));
    }
    if (!sound) return std::nullopt;
    return arguments;
}

void report_ambiguous(const std::string& name, const Object& object, const model::Fluent& fluent,
                      Span span, Context& context) {
    context.report(
        diagnose(ambiguous_name, span, fmt::format("'{}' is both an object and a fluent", name))
            .note(object.span, "the object")
            .note(fluent.span, "the fluent")
            .with_hint("rename one of them"));
}

}  // namespace

Typed check_variable(const ast::Variable& variable, Span span, Scope& scope) {
    const std::optional<model::VariableId> id = resolve_variable(variable.name, span, scope);
    if (!id) return std::nullopt;
    return model::Expr{object_type(scope.context.model.variables[*id].type), span,
                       model::VariableValue{*id}};
}

Typed check_literal(const ast::Literal& literal, Span span, Scope& scope) {
    if (const Object* object = find(scope.context.names.objects, literal.name))
        return check_object("@" + literal.name, *object, span, scope);
    scope.context.report(
        diagnose(unknown_literal, span, fmt::format("no type has the member '@{}'", literal.name))
            .with_hint(suggestion_or_list(scope.context, "@" + literal.name, span,
                                          as_literals(enumerated_members(scope.context)))));
    return std::nullopt;
}

std::optional<model::FluentId> check_fluent(const ast::Reference& reference,
                                            std::size_t argument_count, Span span, Scope& scope) {
    Context& context = scope.context;
    const model::FluentId* id = find(context.names.fluents, reference.name.text);
    if (!id) {
        report_unknown_name(reference, span, scope);
        return std::nullopt;
    }
    context.mentioned.insert(*id);
    if (context.names.broken_fluents.contains(*id)) return std::nullopt;
    const model::Fluent& fluent = context.fluent(*id);
    if (!check_prime(reference, fluent, context)) return std::nullopt;
    scope.fluent_uses.push_back({*id, reference.primed, reference.name.span});
    if (!check_arity(fluent, argument_count, span, context)) return std::nullopt;
    return *id;
}

Typed check_reference(const ast::Reference& reference, Span span, Scope& scope) {
    Context& context = scope.context;
    const std::string& name = reference.name.text;
    const Object* object = find(context.names.objects, name);
    if (object && reference.arguments.empty() && !reference.primed) {
        const model::FluentId* id = find(context.names.fluents, name);
        if (!id || !context.fluent(*id).parameters.empty())
            return check_object(name, *object, span, scope);
        report_ambiguous(name, *object, context.fluent(*id), span, context);
        return std::nullopt;
    }
    const auto id = check_fluent(reference, reference.arguments.size(), span, scope);
    if (!id) return std::nullopt;
    auto arguments = check_arguments(reference, context.fluent(*id), scope);
    if (!arguments) return std::nullopt;
    return model::Expr{context.fluent(*id).range, span,
                       model::Reference{*id, reference.primed, std::move(*arguments)}};
}

}  // namespace rddlc::checking
