#include "check/fluents.hpp"

#include "check/types.hpp"
#include "check/values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace rddlc::checking {
namespace {

enum class Block { Domain, Policy };

// Values are held in dense tables; more than this is a mistake in the instance.
constexpr std::int64_t max_groundings = std::int64_t{1} << 25;
// Non-fluents take as much room as they have values other than the default.
constexpr std::int64_t max_groundings_of_tables = std::int64_t{1} << 40;

// The type of values that other languages call by this name.
std::string range_in_other_languages(std::string name) {
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
    if (name == "float" || name == "double" || name == "number" || name == "real") return "real";
    if (name == "integer" || name == "long" || name == "int") return "int";
    if (name == "boolean" || name == "bool" || name == "logical") return "bool";
    return "";
}

std::optional<model::ValueType> resolve_range(const ast::Name& range, Context& context) {
    if (range.text == "bool") return model::bool_type;
    if (range.text == "int") return model::int_type;
    if (range.text == "real") return model::real_type;
    if (const model::TypeId* id = find(context.names.types, range.text))
        return model::ValueType{model::ValueType::Kind::Object, *id};
    const std::string meant = range_in_other_languages(range.text);
    const auto names = [&] {
        std::vector<std::string> all = keys(context.names.types);
        all.insert(all.end(), {"bool", "int", "real"});
        return all;
    };
    context.report(
        diagnose(unknown_type, range.span, fmt::format("type '{}' is not declared", range.text))
            .with_hint(meant.empty() ? suggestion(context, range.text, range.span, names)
                                     : Hint(fmt::format("'{}' is written '{}'", range.text, meant),
                                            {{range.span, meant}})));
    return std::nullopt;
}

bool has_initial_values(Role role) {
    return role == Role::NonFluent || role == Role::State || role == Role::Action;
}

void check_name(const ast::PVariable& declaration, Context& context) {
    const std::string& name = declaration.name.text;
    if (declaration.primed)
        context.report(diagnose(illegal_fluent_name, declaration.name.span,
                                fmt::format("'{}'' is declared with a prime", name))
                           .with_hint({"declare it without; its next value is written with one",
                                       {{declaration.name.span, name}}}));
    if (name.find("__") != std::string::npos)
        context.report(diagnose(illegal_fluent_name, declaration.name.span,
                                fmt::format("'{}' contains '__'", name))
                           .with_hint("'__' and '___' separate the parts of grounded names"));
}

// A param-fluent is a non-fluent that is meant to be varied.
std::optional<Role> resolve_policy_role(const ast::PVariable& declaration, Context& context) {
    const std::string& kind = declaration.kind.text;
    if (kind == "param-fluent") return Role::NonFluent;
    const std::optional<Role> role = role_named(kind);
    if (role == Role::NonFluent || role == Role::Derived || role == Role::State) return role;
    context.report(diagnose(bad_policy, declaration.kind.span,
                            fmt::format("a policy cannot declare {}s", kind))
                       .with_hint("it declares non-fluents, param-fluents, derived-fluents and "
                                  "state-fluents"));
    return std::nullopt;
}

std::optional<Role> resolve_role(const ast::PVariable& declaration, Block block, Context& context) {
    if (block == Block::Policy) return resolve_policy_role(declaration, context);
    const std::optional<Role> role = role_named(declaration.kind.text);
    if (!role)
        context.report({illegal_declaration, declaration.kind.span,
                        fmt::format("'{}' cannot be declared in a domain", declaration.kind.text)});
    return role;
}

bool resolve_parameters(const ast::PVariable& declaration, model::Fluent& fluent,
                        Context& context) {
    bool known = true;
    for (const ast::Name& parameter : declaration.parameters) {
        const std::optional<model::TypeId> type = resolve_type(parameter, context);
        if (type) fluent.parameters.push_back(*type);
        known = known && type.has_value();
    }
    return known;
}

// Whether its values are the instance's objects, which the domain cannot name.
bool has_object_range(const model::Fluent& fluent, const Context& context) {
    return fluent.range.kind == model::ValueType::Kind::Object &&
           !context.type(fluent.range.type).enumerated;
}

void check_range_of_role(const ast::PVariable& declaration, const model::Fluent& fluent,
                         Context& context) {
    if (!has_object_range(fluent, context)) return;
    const std::string& type = context.type(fluent.range.type).name;
    if (fluent.role == Role::Action)
        context.report(
            diagnose(object_action, declaration.range.span,
                     fmt::format("action-fluent '{}' cannot have the object type '{}' as its range",
                                 fluent.name, type))
                .with_hint(fmt::format("make it a bool action-fluent with a parameter of type '{}'",
                                       type)));
    else if (declaration.default_value)
        context.report(
            diagnose(bad_default, declaration.default_value->span,
                     fmt::format("'{}' cannot have a default: the domain cannot name an object "
                                 "of type '{}'",
                                 fluent.name, type))
                .with_hint("give its values in the instance"));
}

// A policy is given no values by the instance, so its defaults may be objects of the instance.
void resolve_default(const ast::PVariable& declaration, model::Fluent& fluent, Block block,
                     Context& context) {
    if (!has_initial_values(fluent.role)) return;
    if (!declaration.default_value) {
        if (block == Block::Policy)
            context.report(diagnose(bad_policy, declaration.name.span,
                                    fmt::format("'{}' needs a default", fluent.name))
                               .with_hint("the instance gives no values to a policy"));
        return;
    }
    // Any value will do after an error: it matters only that there is a default.
    fluent.default_value = model::Value{false};
    if (block == Block::Domain && has_object_range(fluent, context)) return;
    const std::optional<model::Value> value =
        value_of(*declaration.default_value, fluent, bad_default, context);
    if (value) fluent.default_value = *value;
}

// False if there are too many.
bool check_grounding_count(const model::Fluent& fluent, Context& context) {
    const std::int64_t most =
        fluent.role == Role::NonFluent ? max_groundings_of_tables : max_groundings;
    std::int64_t count = 1;
    for (const model::TypeId parameter : fluent.parameters) {
        if (context.names.open_types.contains(parameter)) continue;
        const model::Type& type = context.type(parameter);
        if (type.objects.empty() && has_initial_values(fluent.role) &&
            !context.names.broken_types.contains(parameter))
            context.report(diagnose(empty_scope, fluent.span,
                                    fmt::format("'{}' has no values: type '{}' is empty",
                                                fluent.name, type.name))
                               .note(type.span, "declared here"));
        count *= static_cast<std::int64_t>(type.objects.size());
        if (count <= most) continue;
        context.report({too_many_groundings, fluent.span,
                        fmt::format("'{}' has more than {} groundings", fluent.name, most)});
        return false;
    }
    return true;
}

void report_repeated(const ast::PVariable& declaration, model::FluentId first, Context& context) {
    const std::string_view what = context.model.policy && !context.model.is_of_policy(first)
                                      ? "is declared in the domain already"
                                      : "is declared twice";
    context.report(diagnose(repeated_fluent, declaration.name.span,
                            fmt::format("'{}' {}", declaration.name.text, what))
                       .note(context.fluent(first).span, "first declared here"));
}

void declare_fluent(const ast::PVariable& declaration, Block block, Context& context) {
    check_name(declaration, context);
    const std::string& name = declaration.name.text;
    const auto id = static_cast<model::FluentId>(context.model.fluents.size());
    const auto [entry, is_new] = context.names.fluents.try_emplace(name, id);
    if (!is_new) return report_repeated(declaration, entry->second, context);
    model::Fluent fluent{name, Role::NonFluent,       {}, model::bool_type,
                         {},   declaration.name.span, {}};
    const std::optional<Role> role = resolve_role(declaration, block, context);
    const std::optional<model::ValueType> range = resolve_range(declaration.range, context);
    bool sound = resolve_parameters(declaration, fluent, context);
    fluent.role = role.value_or(Role::NonFluent);
    fluent.range = range.value_or(model::bool_type);
    if (role && range) {
        if (block == Block::Domain) check_range_of_role(declaration, fluent, context);
        resolve_default(declaration, fluent, block, context);
    }
    sound = sound && check_grounding_count(fluent, context);
    if (!role || !range || !sound) context.names.broken_fluents.insert(id);
    if (role == Role::Derived && block == Block::Domain)
        context.report(
            diagnose(derived_is_interm, declaration.kind.span,
                     fmt::format("derived-fluent '{}' is treated as an interm-fluent", name))
                .with_hint(
                    {"declare it 'interm-fluent'", {{declaration.kind.span, "interm-fluent"}}}));
    context.model.fluents.push_back(std::move(fluent));
}

}  // namespace

void declare_fluents(const Blocks& blocks, Context& context) {
    for (const ast::PVariable& declaration : blocks.pvariables->declarations)
        declare_fluent(declaration, Block::Domain, context);
}

void declare_policy_fluents(const Blocks& blocks, Context& context) {
    if (!blocks.policy_pvariables) return;
    for (const ast::PVariable& declaration : blocks.policy_pvariables->declarations)
        declare_fluent(declaration, Block::Policy, context);
    for (model::FluentId id = context.model.policy->first_fluent; id < context.model.fluents.size();
         ++id) {
        model::Fluent& fluent = context.model.fluents[id];
        if (has_initial_values(fluent.role) && !context.names.broken_fluents.contains(id))
            fill_with_default(fluent, context);
    }
}

void warn_of_unused_fluents(Context& context) {
    // Random initial values may use non-fluents.
    const bool instance_may_use = !context.needs_instance && context.standard == Standard::Rddlc;
    for (model::FluentId id = 0; id < context.model.fluents.size(); ++id) {
        const model::Fluent& fluent = context.fluent(id);
        if (fluent.role == Role::Observ || context.mentioned.contains(id)) continue;
        if (fluent.role == Role::NonFluent && instance_may_use) continue;
        context.report({unused_fluent, fluent.span,
                        fmt::format("{} '{}' is never used", name_of(fluent.role), fluent.name)});
    }
}

}  // namespace rddlc::checking
