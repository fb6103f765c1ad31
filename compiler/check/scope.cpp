#include "check/scope.hpp"

#include "check/open_ends.hpp"
#include "check/types.hpp"
#include "support/suggestion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace rddlc::checking {
namespace {

// The innermost of that name.
const Binding* find_binding(const Scope& scope, const std::string& name) {
    const auto found =
        std::ranges::find(scope.bindings.rbegin(), scope.bindings.rend(), name, &Binding::name);
    return found == scope.bindings.rend() ? nullptr : &*found;
}

Hint hint_for_unbound(const std::string& name, Span span, const Scope& scope) {
    std::vector<std::string> names;
    for (const Binding& binding : scope.bindings) names.push_back(binding.name);
    if (names.empty()) return "no variable is bound here";
    if (const auto near = name_meant(scope.context, name, [&] { return names; }))
        return hint_of_name("?" + *near, span);
    constexpr std::size_t most_shown = 10;
    const bool all = names.size() <= most_shown;
    if (!all) names.resize(most_shown);
    return fmt::format("bound here: ?{}{}", fmt::join(names, ", ?"), all ? "" : ", ...");
}

void report_unknown(const std::string& name, Span span, Scope& scope) {
    Diagnostic diagnostic{unknown_variable, span,
                          fmt::format("variable '?{}' is not bound here", name)};
    const auto ended = std::ranges::find(scope.ended, name, &EndedBinding::name);
    if (ended == scope.ended.end()) {
        scope.context.report(std::move(diagnostic).with_hint(hint_for_unbound(name, span, scope)));
        return;
    }
    scope.context.report(
        std::move(diagnostic)
            .note(last_character(ended->span),
                  fmt::format("the '{}' that binds '?{}' ends here", ended->binder, name)));
}

}  // namespace

std::optional<model::VariableId> bind(const ast::Name& name, std::optional<model::TypeId> type,
                                      Scope& scope) {
    if (const Binding* outer = find_binding(scope, name.text)) {
        scope.context.report(diagnose(repeated_variable, name.span,
                                      fmt::format("variable '?{}' is bound already", name.text))
                                 .note(outer->span, "bound here")
                                 .with_hint(hint_for_bound_again(name.text, scope)));
        type.reset();
    }
    std::optional<model::VariableId> variable;
    if (type) {
        std::vector<model::Variable>& variables = scope.context.model.variables;
        variable = static_cast<model::VariableId>(variables.size());
        variables.push_back({name.text, *type, name.span});
    }
    scope.bindings.push_back({name.text, variable, name.span});
    return variable;
}

Binder::Binder(const std::vector<ast::TypedVariable>& variables, std::string_view what, Span whole,
               Scope& scope)
    : scope_(scope), outer_(scope.bindings.size()), what_(what), whole_(whole) {
    for (const ast::TypedVariable& typed : variables)
        variables_.push_back(bind(typed.variable, resolve_type(typed.type, scope.context), scope));
}

Binder::~Binder() {
    while (scope_.bindings.size() > outer_) {
        scope_.ended.push_back({scope_.bindings.back().name, what_, whole_});
        scope_.bindings.pop_back();
    }
}

std::optional<std::vector<model::VariableId>> Binder::variables() const {
    std::vector<model::VariableId> result;
    for (const std::optional<model::VariableId>& variable : variables_) {
        if (!variable) return std::nullopt;
        result.push_back(*variable);
    }
    return result;
}

std::optional<model::VariableId> resolve_variable(const std::string& name, Span span,
                                                  Scope& scope) {
    const Binding* binding = find_binding(scope, name);
    if (!binding) {
        report_unknown(name, span, scope);
        return std::nullopt;
    }
    if (binding->variable) scope.variable_uses.push_back({*binding->variable, span});
    return binding->variable;
}

}  // namespace rddlc::checking
