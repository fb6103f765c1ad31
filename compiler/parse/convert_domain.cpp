#include "parse/codes.hpp"
#include "parse/convert.hpp"

#include <fmt/format.h>

namespace rddlc {

namespace {

// -------------------------------------------------------------------------- types and fluents

ast::TypeDeclaration to_type(const Conversion& conversion,
                             Parser::TypeDeclarationContext& context) {
    std::optional<std::vector<ast::Name>> members;
    if (context.enumeration()) members = to_names(conversion, context.enumeration()->ENUM());
    return {to_name(conversion, context.ID()), std::move(members), span_of(conversion, context)};
}

ast::Name to_name(const Conversion& conversion, Parser::TypeNameContext& context) {
    return rddlc::to_name(conversion, *context.getStart());
}

bool takes_default(std::string_view kind) {
    return kind == "non-fluent" || kind == "state-fluent" || kind == "action-fluent" ||
           kind == "param-fluent";
}

bool takes_level(std::string_view kind) {
    return kind == "interm-fluent" || kind == "derived-fluent";
}

std::string attribute_hint(std::string_view kind) {
    if (takes_level(kind)) return fmt::format("'{}' has a value only by its definition", kind);
    if (takes_default(kind)) return "only 'interm-fluent' and 'derived-fluent' have a level";
    return "observations have neither default nor level";
}

Span with_comma_before(const Conversion& conversion, Parser::AttributeContext& context) {
    auto& declaration = static_cast<Parser::PvariableContext&>(*context.parent);
    Span span = span_of(conversion, context);
    for (antlr4::tree::TerminalNode* comma : declaration.COMMA()) {
        const Span place = span_of(conversion.file, *comma->getSymbol());
        if (place.end <= span_of(conversion, context).begin) span.begin = place.begin;
    }
    return span;
}

// The value of "nothing is done" in most domains; nothing for a type of the domain's own.
std::string usual_default(std::string_view range) {
    if (range == "bool") return "false";
    if (range == "int") return "0";
    return range == "real" ? "0.0" : "";
}

// Adds a default at the end of the declaration.
std::vector<Replacement> added_default(const Conversion& conversion,
                                       Parser::PvariableContext& context,
                                       const ast::PVariable& pvariable) {
    const std::string value = usual_default(pvariable.range.text);
    if (value.empty()) return {};
    const Span last = context.attribute().empty()
                          ? pvariable.range.span
                          : span_of(conversion, *context.attribute().back());
    return {{{last.file, last.end, last.end}, ", default = " + value}};
}

// Fills `slot`, or says why not.
void set_attribute(const Conversion& conversion, Parser::AttributeContext& context,
                   std::string_view kind, bool allowed, std::optional<ast::Constant>& slot) {
    const std::string key = context.getStart()->getText();
    const Span span = span_of(conversion, context);
    if (!allowed)
        conversion.diagnostics.report(
            Diagnostic{wrong_attribute, span, fmt::format("'{}' takes no {}", kind, key)}.with_hint(
                {attribute_hint(kind), {{with_comma_before(conversion, context), ""}}}));
    else if (slot)
        conversion.diagnostics.report(
            Diagnostic{wrong_attribute, span, fmt::format("a second {}", key)}
                .note(slot->span, "first given here")
                .fixed_by(with_comma_before(conversion, context), ""));
    else
        slot = to_constant(conversion, *context.constant());
}

void set_attributes(const Conversion& conversion, Parser::PvariableContext& context,
                    ast::PVariable& pvariable) {
    const std::string& kind = pvariable.kind.text;
    for (Parser::AttributeContext* attribute : context.attribute()) {
        if (attribute->DEFAULT())
            set_attribute(conversion, *attribute, kind, takes_default(kind),
                          pvariable.default_value);
        else
            set_attribute(conversion, *attribute, kind, takes_level(kind), pvariable.level);
    }
    if (kind == "action-fluent" && !pvariable.default_value)
        conversion.diagnostics.report(
            Diagnostic{wrong_attribute, pvariable.span,
                       fmt::format("action-fluent '{}' needs a default", pvariable.name.text)}
                .with_hint({"the default is the action's value when the agent does nothing, as in "
                            "{ action-fluent, bool, default = false }",
                            added_default(conversion, context, pvariable)}));
}

ast::PVariable to_pvariable(const Conversion& conversion, Parser::PvariableContext& context) {
    auto [name, primed] = to_primed_name(conversion, context.ID());
    std::vector<ast::Name> types;
    for (Parser::TypeNameContext* type : context.typeName())
        types.push_back(to_name(conversion, *type));
    ast::Name range = std::move(types.back());  // the last stands between the curly brackets
    types.pop_back();
    ast::PVariable pvariable{.name = std::move(name),
                             .primed = primed,
                             .parameters = std::move(types),
                             .kind = to_name(conversion, context.FLUENT_KIND()),
                             .range = std::move(range),
                             .default_value = {},
                             .level = {},
                             .span = span_of(conversion, context)};
    set_attributes(conversion, context, pvariable);
    return pvariable;
}

// -------------------------------------------------------------------- definitions, conditions

ast::Cpf to_cpf(const Conversion& conversion, Parser::CpfContext& context) {
    auto [name, primed] = to_primed_name(conversion, context.ID());
    return {std::move(name), primed, to_names(conversion, context.VAR()),
            context.randomVector() ? to_expr(conversion, *context.randomVector())
                                   : to_expr(conversion, *context.expr()),
            span_of(conversion, context)};
}

ast::ConstraintKind constraint_kind(std::string_view keyword) {
    if (keyword == "termination") return ast::ConstraintKind::Termination;
    if (keyword == "action-preconditions") return ast::ConstraintKind::ActionPreconditions;
    if (keyword == "state-invariants") return ast::ConstraintKind::StateInvariants;
    return ast::ConstraintKind::StateActionConstraints;
}

// ----------------------------------------------------------------------------------- sections

using DomainNode = decltype(ast::DomainSection::node);

template <class Item, class Context, class Convert>
std::vector<Item> each(const Conversion& conversion, const std::vector<Context*>& contexts,
                       Convert convert) {
    std::vector<Item> items;
    items.reserve(contexts.size());
    for (Context* context : contexts) items.push_back(convert(conversion, *context));
    return items;
}

DomainNode to_node(const Conversion& conversion, Parser::DomainSectionContext& context) {
    if (auto* requirements = as<Parser::RequirementsContext>(context))
        return ast::Requirements{to_names(conversion, requirements->ID())};
    if (auto* types = as<Parser::TypesContext>(context))
        return ast::Types{
            each<ast::TypeDeclaration>(conversion, types->typeDeclaration(), to_type)};
    if (auto* pvariables = as<Parser::PvariablesContext>(context))
        return ast::PVariables{
            each<ast::PVariable>(conversion, pvariables->pvariable(), to_pvariable)};
    if (auto* cpfs = as<Parser::CpfsContext>(context))
        return ast::Cpfs{rddlc::to_name(conversion, cpfs->CPFS()),
                         each<ast::Cpf>(conversion, cpfs->cpf(), to_cpf)};
    if (auto* reward = as<Parser::RewardContext>(context))
        return ast::Reward{to_expr(conversion, *reward->expr())};
    auto& constraints = *as<Parser::ConstraintsContext>(context);
    ast::Constraints result{constraint_kind(constraints.CONSTRAINTS()->getText()), {}};
    for (Parser::ConditionContext* condition : constraints.condition())
        result.conditions.push_back(to_expr(conversion, *condition->expr()));
    return result;
}

ast::DomainSection to_section(const Conversion& conversion, Parser::DomainSectionContext& context) {
    return {to_node(conversion, context), span_of(conversion, context)};
}

ast::DomainSection to_policy_section(const Conversion& conversion,
                                     Parser::PolicySectionContext& context) {
    if (context.domainSection()) return to_section(conversion, *context.domainSection());
    return {ast::DomainName{to_name(conversion, context.ID())}, span_of(conversion, context)};
}

}  // namespace

ast::Domain to_domain(const Conversion& conversion, Parser::DomainContext& context) {
    return {to_name(conversion, context.ID()),
            each<ast::DomainSection>(conversion, context.domainSection(), to_section),
            span_of(conversion, context)};
}

ast::Policy to_policy(const Conversion& conversion, Parser::PolicyContext& context) {
    return {to_name(conversion, context.ID()),
            each<ast::DomainSection>(conversion, context.policySection(), to_policy_section),
            span_of(conversion, context)};
}

}  // namespace rddlc
