// `if`, `switch`, and the distribution that lists the members of a type.
#include "check/expressions.hpp"
#include "check/names.hpp"
#include "check/types.hpp"

#include <fmt/format.h>

#include <utility>

namespace rddlc::checking {
namespace {

// ----------------------------------------------------------------------------------- if

void warn_of_constant_condition(const ast::Expr& condition, Context& context) {
    const auto* constant = std::get_if<ast::Boolean>(&without_groups(condition).node);
    if (constant)
        context.report({constant_condition, condition.span,
                        fmt::format("the condition is always {}", constant->value)});
}

// The type that all branches can have: one object type, or the largest of the primitive ones.
// Reports an error if there is no such type.
std::optional<model::ValueType> common_type(const std::vector<const model::Expr*>& branches,
                                            std::string_view what, Scope& scope) {
    model::ValueType type = branches.front()->type;
    for (const model::Expr* branch : branches) {
        const bool fits = is_object(type) || is_object(branch->type) ? type == branch->type : true;
        if (!fits) {
            scope.context.report(diagnose(branches_differ, branch->span,
                                          fmt::format("the {} gives {} here, but {} before", what,
                                                      describe(scope.context, branch->type),
                                                      describe(scope.context, type)))
                                     .note(branches.front()->span, "before"));
            return std::nullopt;
        }
        if (!is_object(type)) type = promoted(type, branch->type);
    }
    return type;
}

// ------------------------------------------------------------------------- labelled cases

struct Label {
    std::string_view name;
    Span span;
};

// The label that names each member of the type. Reports labels that name no member and labels used
// twice.
std::optional<std::vector<std::optional<std::size_t>>> match_labels(
    const std::vector<Label>& labels, model::TypeId type_id, Context& context) {
    const model::Type& type = context.type(type_id);
    std::vector<std::optional<std::size_t>> label_of(type.objects.size());
    bool sound = true;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const Object* object = find(context.names.objects, std::string(labels[i].name));
        if (!object || object->type != type_id) {
            const std::string literal = fmt::format("@{}", labels[i].name);
            context.report(
                diagnose(bad_label, labels[i].span,
                         fmt::format("'{}' is not a member of type '{}'", literal, type.name))
                    .note(type.span, "declared here")
                    .with_hint(suggestion(context, literal, labels[i].span,
                                          [&] { return as_literals(type.objects); })));
            sound = false;
            continue;
        }
        std::optional<std::size_t>& slot = label_of[static_cast<std::size_t>(object->index)];
        if (slot) {
            context.report(diagnose(repeated_label, labels[i].span,
                                    fmt::format("'@{}' occurs twice", labels[i].name))
                               .note(labels[*slot].span, "first here"));
            sound = false;
        }
        slot = i;
    }
    if (!sound) return std::nullopt;
    return label_of;
}

bool check_complete(const std::vector<std::optional<std::size_t>>& label_of, model::TypeId type_id,
                    Span span, std::string_view hint, Context& context) {
    const model::Type& type = context.type(type_id);
    std::vector<std::string> missing;
    for (std::size_t i = 0; i < label_of.size(); ++i)
        if (!label_of[i]) missing.push_back(fmt::format("'@{}'", type.objects[i]));
    if (missing.empty()) return true;
    context.report(diagnose(missing_label, span,
                            fmt::format("no case for {} of type '{}'", joined(missing), type.name))
                       .note(type.span, "declared here")
                       .with_hint(std::string(hint)));
    return false;
}

// -------------------------------------------------------------------------------- switch

// The value of an enumerated fluent.
Typed check_subject(const ast::Expr& expression, Scope& scope) {
    Typed subject = check_expression(expression, scope);
    if (!subject) return std::nullopt;
    const bool enumerated =
        is_object(subject->type) && scope.context.type(subject->type.type).enumerated;
    if (std::holds_alternative<model::Reference>(subject->node) && enumerated) return subject;
    scope.context.report(
        diagnose(bad_switch_subject, expression.span,
                 enumerated ? "'switch' takes a fluent"
                            : fmt::format("'switch' takes a fluent of an enumerated type, found {}",
                                          describe(scope.context, subject->type)))
            .with_hint(enumerated ? "compare with '==' in an 'if', or make it an interm-fluent"
                                  : "use 'if (...) then ... else if ...'"));
    return std::nullopt;
}

// The labels of all cases except the default, which is at most one. False if some are not literals.
bool collect_labels(const ast::Switch& choice, std::vector<Label>& labels,
                    std::vector<const ast::SwitchCase*>& labelled, const ast::SwitchCase*& fallback,
                    Context& context) {
    bool sound = true;
    for (const ast::SwitchCase& item : choice.cases) {
        if (!item.label) {
            if (fallback) {
                context.report(diagnose(repeated_label, item.span, "'default' occurs twice")
                                   .note(fallback->span, "first here"));
                sound = false;
            }
            fallback = &item;
            continue;
        }
        const ast::Expr& label = **item.label;
        if (const auto* literal = std::get_if<ast::Literal>(&label.node)) {
            labels.push_back({literal->name, label.span});
            labelled.push_back(&item);
            continue;
        }
        sound = false;
        const auto* bare = std::get_if<ast::Reference>(&label.node);
        const bool is_object = bare && find(context.names.objects, bare->name.text);
        const Hint hint = is_object ? Hint(fmt::format("write '@{}'", bare->name.text),
                                           {{point_before(label.span), "@"}})
                                    : Hint{};
        context.report(diagnose(bad_label, label.span, "a case is labelled with a literal '@...'")
                           .with_hint(hint));
    }
    return sound;
}

std::vector<const model::Expr*> values_of(const std::vector<Typed>& values,
                                          const Typed& default_value) {
    std::vector<const model::Expr*> all;
    for (const Typed& value : values) all.push_back(&*value);
    if (default_value) all.push_back(&*default_value);
    return all;
}

}  // namespace

Typed check_if(const ast::If& conditional, Span span, Scope& scope) {
    Typed condition = require_bool(check_expression(*conditional.condition, scope),
                                   "the condition of 'if'", scope);
    Typed then_branch = check_expression(*conditional.then_branch, scope);
    Typed else_branch = check_expression(*conditional.else_branch, scope);
    warn_of_constant_condition(*conditional.condition, scope.context);
    if (!condition || !then_branch || !else_branch) return std::nullopt;
    const std::optional<model::ValueType> type =
        common_type({&*then_branch, &*else_branch}, "'if'", scope);
    if (!type) return std::nullopt;
    return model::Expr{*type, span,
                       model::If{std::move(*condition), convert(std::move(*then_branch), *type),
                                 convert(std::move(*else_branch), *type)}};
}

Typed check_switch(const ast::Switch& choice, Span span, Scope& scope) {
    std::vector<Label> labels;
    std::vector<const ast::SwitchCase*> labelled;
    const ast::SwitchCase* fallback = nullptr;
    const bool literals = collect_labels(choice, labels, labelled, fallback, scope.context);

    Typed subject = check_subject(*choice.subject, scope);
    std::vector<Typed> values;
    bool sound = literals && subject.has_value();
    for (const ast::SwitchCase* item : labelled) {
        values.push_back(check_expression(*item->value, scope));
        sound = sound && values.back().has_value();
    }
    Typed default_value;
    if (fallback) {
        default_value = check_expression(*fallback->value, scope);
        sound = sound && default_value.has_value();
    }
    if (!subject) return std::nullopt;

    const model::TypeId enumeration = subject->type.type;
    const auto label_of = match_labels(labels, enumeration, scope.context);
    if (!label_of || !sound) return std::nullopt;
    if (!fallback && !check_complete(*label_of, enumeration, span,
                                     "add the cases, or 'default: ...'", scope.context))
        return std::nullopt;
    const auto type = common_type(values_of(values, default_value), "'switch'", scope);
    if (!type) return std::nullopt;

    model::Switch node{std::move(*subject), {}, {}};
    for (const std::optional<std::size_t>& label : *label_of) {
        node.cases.emplace_back();
        if (label) node.cases.back() = convert(std::move(*values[*label]), *type);
    }
    if (default_value) node.default_case = convert(std::move(*default_value), *type);
    return model::Expr{*type, span, std::move(node)};
}

Typed check_discrete(const ast::DiscreteCases& discrete, Span span, Scope& scope) {
    Context& context = scope.context;
    scope.draws.push_back(span);
    std::vector<Label> labels;
    std::vector<Typed> weights;
    bool sound = true;
    for (const ast::LabelledWeight& item : discrete.weights) {
        labels.push_back({item.label.text, item.label.span});
        weights.push_back(require_real(check_expression(*item.weight, scope),
                                       fmt::format("the weight of '@{}'", item.label.text), scope));
        sound = sound && weights.back().has_value();
    }
    const std::optional<model::TypeId> type = resolve_type(discrete.type, context);
    if (!type) return std::nullopt;
    if (!context.type(*type).enumerated) {
        context.report(
            diagnose(not_enumerated, discrete.type.span,
                     fmt::format("'{}' lists members, but type '{}' is not enumerated",
                                 discrete.name.text, discrete.type.text))
                .note(context.type(*type).span, "declared here")
                .with_hint(fmt::format("for objects of the instance: '{}_{{?x : {}}} ...'",
                                       discrete.name.text, discrete.type.text)));
        return std::nullopt;
    }
    const auto label_of = match_labels(labels, *type, context);
    if (!label_of || !sound) return std::nullopt;
    if (!check_complete(*label_of, *type, span, "every member needs a weight, 0.0 if need be",
                        context))
        return std::nullopt;
    model::Discrete node{discrete.name.text == "UnnormDiscrete", *type, {}};
    for (const std::optional<std::size_t>& label : *label_of)
        node.weights.push_back(std::move(*weights[*label]));
    return model::Expr{{model::ValueType::Kind::Object, *type}, span, std::move(node)};
}

}  // namespace rddlc::checking
