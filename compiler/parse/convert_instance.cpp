#include "parse/convert.hpp"

namespace rddlc {

namespace {

using InstanceNode = decltype(ast::InstanceSection::node);

// ------------------------------------------------------------------------------------- values

void set_arguments(const Conversion& conversion, Parser::SymbolsContext* context,
                   ast::Assignment& assignment) {
    if (context == nullptr) return;
    for (Parser::SymbolContext* symbol : context->symbol()) {
        assignment.arguments.push_back(to_symbol(*symbol));
        assignment.argument_spans.push_back(span_of(conversion, *symbol));
    }
}

ast::Assignment to_assignment(const Conversion& conversion, Parser::AssignmentContext& context) {
    ast::Assignment assignment;
    assignment.span = span_of(conversion, context);
    if (auto* unset = as<Parser::UnsetContext>(context)) {
        assignment.name = to_name(conversion, unset->ID());
        assignment.negated = true;
        set_arguments(conversion, unset->symbols(), assignment);
        return assignment;
    }
    auto& set = *as<Parser::SetContext>(context);
    assignment.name = to_name(conversion, set.ID());
    set_arguments(conversion, set.symbols(), assignment);
    if (set.constant()) assignment.value = to_constant(conversion, *set.constant());
    if (set.draw()) assignment.value = ast::ExprBox(to_expr(conversion, *set.draw()));
    return assignment;
}

std::vector<ast::Assignment> to_assignments(
    const Conversion& conversion, const std::vector<Parser::AssignmentContext*>& contexts) {
    std::vector<ast::Assignment> assignments;
    assignments.reserve(contexts.size());
    for (Parser::AssignmentContext* context : contexts)
        assignments.push_back(to_assignment(conversion, *context));
    return assignments;
}

ast::ObjectList to_object_list(const Conversion& conversion, Parser::ObjectListContext& context) {
    std::vector<ast::Name> names = to_names(conversion, context.ID());
    ast::Name type = std::move(names.front());
    names.erase(names.begin());
    return {std::move(type), std::move(names)};
}

// ------------------------------------------------------------------------------------ numbers

// Nothing for pos-inf.
std::optional<ast::Integer> to_limit(const Conversion& conversion, Parser::LimitContext& context) {
    if (!context.INT()) return std::nullopt;
    return to_integer(conversion, context.getText(), span_of(conversion, context));
}

ast::Horizon to_horizon(const Conversion& conversion, Parser::HorizonContext& context) {
    if (context.terminateWhen()) return {to_expr(conversion, *context.terminateWhen()->expr())};
    if (const auto limit = to_limit(conversion, *context.limit())) return {*limit};
    return {ast::PosInf{}};
}

ast::MaxNondefActions to_max_nondef_actions(const Conversion& conversion,
                                            Parser::MaxNondefActionsContext& context) {
    const auto limit = to_limit(conversion, *context.limit());
    return {limit ? std::optional(limit->value) : std::nullopt};
}

ast::Discount to_discount(const Conversion& conversion, Parser::DiscountContext& context) {
    antlr4::tree::TerminalNode* number = context.REAL() ? context.REAL() : context.INT();
    const Span span = span_of(conversion.file, *number->getSymbol());
    if (context.INT()) return {to_integer(conversion, number->getText(), span)};
    return {to_real(conversion, number->getText(), span)};
}

// ----------------------------------------------------------------------------------- sections

InstanceNode to_node(const Conversion& conversion, Parser::NonFluentsSectionContext& context) {
    if (auto* domain = as<Parser::DomainNameContext>(context))
        return ast::DomainName{to_name(conversion, domain->ID())};
    if (auto* values = as<Parser::NonFluentValuesContext>(context))
        return ast::NonFluentValues{to_assignments(conversion, values->assignment())};
    ast::Objects objects;
    for (Parser::ObjectListContext* list : as<Parser::ObjectsContext>(context)->objectList())
        objects.lists.push_back(to_object_list(conversion, *list));
    return objects;
}

InstanceNode to_node(const Conversion& conversion, Parser::InstanceSectionContext& context) {
    if (auto* shared = as<Parser::SharedSectionContext>(context))
        return to_node(conversion, *shared->nonFluentsSection());
    if (auto* name = as<Parser::NonFluentsNameContext>(context))
        return ast::NonFluentsName{to_name(conversion, name->ID())};
    if (auto* init_state = as<Parser::InitStateContext>(context))
        return ast::InitState{to_assignments(conversion, init_state->assignment())};
    if (auto* limit = as<Parser::MaxNondefActionsContext>(context))
        return to_max_nondef_actions(conversion, *limit);
    if (auto* horizon = as<Parser::HorizonContext>(context))
        return to_horizon(conversion, *horizon);
    return to_discount(conversion, *as<Parser::DiscountContext>(context));
}

template <class Context>
std::vector<ast::InstanceSection> to_sections(const Conversion& conversion,
                                              const std::vector<Context*>& contexts) {
    std::vector<ast::InstanceSection> sections;
    for (Context* context : contexts)
        sections.push_back({to_node(conversion, *context), span_of(conversion, *context)});
    return sections;
}

}  // namespace

ast::Instance to_instance(const Conversion& conversion, Parser::InstanceContext& context) {
    return {to_name(conversion, context.ID()), to_sections(conversion, context.instanceSection()),
            span_of(conversion, context)};
}

ast::NonFluents to_non_fluents(const Conversion& conversion, Parser::NonFluentsContext& context) {
    return {to_name(conversion, context.ID()), to_sections(conversion, context.nonFluentsSection()),
            span_of(conversion, context)};
}

}  // namespace rddlc
