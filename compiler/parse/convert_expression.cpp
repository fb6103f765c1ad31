#include "parse/convert.hpp"

namespace rddlc {

namespace {

ast::ExprBox to_box(const Conversion& conversion, Parser::ExprContext* context) {
    return to_expr(conversion, *context);
}

std::vector<ast::Expr> to_exprs(const Conversion& conversion,
                                const std::vector<Parser::ExprContext*>& contexts) {
    std::vector<ast::Expr> exprs;
    exprs.reserve(contexts.size());
    for (Parser::ExprContext* context : contexts) exprs.push_back(to_expr(conversion, *context));
    return exprs;
}

// -------------------------------------------------------------------------------------- binders

ast::TypedVariable to_typed_variable(const Conversion& conversion,
                                     Parser::TypedVariableContext& context) {
    return {to_name(conversion, context.VAR()), to_name(conversion, context.ID())};
}

std::vector<ast::TypedVariable> to_variables(const Conversion& conversion,
                                             Parser::BinderContext& context) {
    std::vector<ast::TypedVariable> variables;
    for (Parser::TypedVariableContext* variable : context.typedVariable())
        variables.push_back(to_typed_variable(conversion, *variable));
    return variables;
}

// The same for an expression and for an argument of a fluent.
template <class Context>
ast::ExprNode to_aggregation(const Conversion& conversion, Context& context) {
    return ast::Aggregation{to_name(conversion, *context.getStart()),
                            to_variables(conversion, *context.binder()),
                            to_box(conversion, context.expr())};
}

template <class Context>
ast::ExprNode to_discrete_over(const Conversion& conversion, Context& context) {
    return ast::DiscreteOver{to_name(conversion, context.DISCRETE()),
                             to_variables(conversion, *context.binder()),
                             to_box(conversion, context.expr())};
}

// --------------------------------------------------------------------------------------- terms

ast::Expr to_term(const Conversion& conversion, Parser::TermContext& context);

ast::ExprNode to_node(const Conversion& conversion, Parser::SimpleTermContext& context) {
    if (auto* variable = as<Parser::VariableContext>(context))
        return ast::Variable{to_name(conversion, variable->VAR()).text};
    if (auto* literal = as<Parser::LiteralContext>(context))
        return ast::Literal{to_name(conversion, literal->ENUM()).text};
    auto& reference = *as<Parser::ReferenceContext>(context);
    auto [name, primed] = to_primed_name(conversion, reference.ID());
    std::vector<ast::Expr> arguments;
    for (Parser::TermContext* term : reference.term())
        arguments.push_back(to_term(conversion, *term));
    return ast::Reference{std::move(name), primed, std::move(arguments)};
}

ast::ExprNode to_node(const Conversion& conversion, Parser::TermContext& context) {
    if (auto* plain = as<Parser::PlainTermContext>(context))
        return to_node(conversion, *plain->simpleTerm());
    if (auto* argument_of = as<Parser::ArgumentOfTermContext>(context))
        return to_aggregation(conversion, *argument_of);
    return to_discrete_over(conversion, *as<Parser::DiscreteTermContext>(context));
}

ast::Expr to_term(const Conversion& conversion, Parser::TermContext& context) {
    return {to_node(conversion, context), span_of(conversion, context)};
}

// -------------------------------------------------------------------------- vectors and slots

ast::Slot to_slot(const Conversion& conversion, Parser::SlotContext& context) {
    using Kind = ast::Slot::Kind;
    if (context.VAR()) return {Kind::Variable, to_name(conversion, context.VAR())};
    if (context.ENUM()) return {Kind::Literal, to_name(conversion, context.ENUM())};
    return {Kind::Underscore, {"", span_of(conversion, context)}};
}

std::vector<ast::Slot> to_slots(const Conversion& conversion,
                                const std::vector<Parser::SlotContext*>& contexts) {
    std::vector<ast::Slot> slots;
    for (Parser::SlotContext* slot : contexts) slots.push_back(to_slot(conversion, *slot));
    return slots;
}

std::vector<ast::VectorReference> to_vectors(const Conversion& conversion,
                                             Parser::VectorReferencesContext* context) {
    std::vector<ast::VectorReference> vectors;
    if (context == nullptr) return vectors;
    for (Parser::VectorReferenceContext* reference : context->vectorReference())
        vectors.push_back({to_name(conversion, reference->ID()),
                           to_slots(conversion, reference->slot()),
                           span_of(conversion, *reference)});
    return vectors;
}

// ----------------------------------------------------------------------------------- operators

ast::UnaryOperator unary_operator(const Token& token) {
    switch (token.getType()) {
        case Parser::NOT:
            return ast::UnaryOperator::Not;
        case Parser::MINUS:
            return ast::UnaryOperator::Minus;
        default:
            return ast::UnaryOperator::Plus;
    }
}

ast::BinaryOperator binary_operator(const Token& token) {
    using enum ast::BinaryOperator;
    switch (token.getType()) {
        case Parser::EQUIVALENT:
            return Equivalent;
        case Parser::IMPLIES:
            return Implies;
        case Parser::OR:
            return Or;
        case Parser::AND:
        case Parser::AMPERSAND:
            return And;
        case Parser::EQUAL:
            return Equal;
        case Parser::NOT_EQUAL:
            return NotEqual;
        case Parser::LESS:
            return Less;
        case Parser::LESS_EQUAL:
            return LessEqual;
        case Parser::GREATER:
            return Greater;
        case Parser::GREATER_EQUAL:
            return GreaterEqual;
        case Parser::PLUS:
            return Add;
        case Parser::MINUS:
            return Subtract;
        case Parser::TIMES:
            return Multiply;
        default:
            return Divide;
    }
}

// ------------------------------------------------------------------ one function an alternative

ast::ExprNode to_node(const Conversion&, Parser::BooleanContext& context) {
    return ast::Boolean{context.getText() == "true"};
}

ast::ExprNode to_node(const Conversion& conversion, Parser::IntegerContext& context) {
    return to_integer(conversion, context.getText(), span_of(conversion, context));
}

ast::ExprNode to_node(const Conversion& conversion, Parser::RealContext& context) {
    return to_real(conversion, context.getText(), span_of(conversion, context));
}

ast::ExprNode to_node(const Conversion& conversion, Parser::TermExprContext& context) {
    return to_node(conversion, *context.simpleTerm());
}

ast::ExprNode to_node(const Conversion& conversion, Parser::GroupContext& context) {
    return ast::Group{context.OPEN_SQUARE() != nullptr, to_box(conversion, context.expr())};
}

ast::ExprNode to_node(const Conversion& conversion, Parser::CallContext& context) {
    return ast::Call{to_name(conversion, context.ID()), to_exprs(conversion, context.expr())};
}

// A distribution is an expression or an initial value.
template <class Context>
ast::Distribution to_distribution(const Conversion& conversion, Context& context) {
    return {to_name(conversion, context.DISTRIBUTION()), to_exprs(conversion, context.expr())};
}

template <class Context>
ast::DiscreteCases to_discrete_cases(const Conversion& conversion, Context& context) {
    ast::DiscreteCases discrete{
        to_name(conversion, context.DISCRETE()), to_name(conversion, context.ID()), {}};
    const auto labels = context.symbol();
    const auto weights = context.expr();
    for (std::size_t i = 0; i < labels.size(); ++i)
        discrete.weights.push_back({to_name(conversion, *labels[i]->getStart()),
                                    labels[i]->ENUM() != nullptr, to_box(conversion, weights[i])});
    return discrete;
}

ast::ExprNode to_node(const Conversion& conversion, Parser::DistributionContext& context) {
    return to_distribution(conversion, context);
}

ast::ExprNode to_node(const Conversion& conversion, Parser::DiscreteCasesContext& context) {
    return to_discrete_cases(conversion, context);
}

ast::ExprNode to_node(const Conversion& conversion, Parser::MatrixFunctionContext& context) {
    return ast::MatrixFunction{
        to_name(conversion, context.MATRIX()), to_name(conversion, context.VAR(0)),
        to_name(conversion, context.VAR(1)), to_box(conversion, context.expr())};
}

ast::ExprNode to_node(const Conversion& conversion, Parser::ExternalContext& context) {
    return ast::External{to_name(conversion, context.ID()), to_slots(conversion, context.slot()),
                         to_vectors(conversion, context.vectorReferences())};
}

ast::SwitchCase to_switch_case(const Conversion& conversion, Parser::SwitchCaseContext& context) {
    std::optional<ast::ExprBox> label;
    if (context.term()) label = to_term(conversion, *context.term());
    return {std::move(label), to_box(conversion, context.expr()), span_of(conversion, context)};
}

ast::ExprNode to_node(const Conversion& conversion, Parser::SwitchContext& context) {
    ast::Switch node{to_box(conversion, context.expr()), {}};
    for (Parser::SwitchCaseContext* entry : context.switchCase())
        node.cases.push_back(to_switch_case(conversion, *entry));
    return node;
}

ast::ExprNode to_node(const Conversion& conversion, Parser::UnaryContext& context) {
    return ast::Unary{unary_operator(*context.op), to_box(conversion, context.expr())};
}

ast::ExprNode to_node(const Conversion& conversion, Parser::BinaryContext& context) {
    return ast::Binary{binary_operator(*context.op), span_of(conversion.file, *context.op),
                       context.op->getType() == Parser::AMPERSAND,
                       to_box(conversion, context.expr(0)), to_box(conversion, context.expr(1))};
}

ast::ExprNode to_node(const Conversion& conversion, Parser::IfContext& context) {
    return ast::If{to_box(conversion, context.expr(0)), to_box(conversion, context.expr(1)),
                   to_box(conversion, context.expr(2))};
}

ast::ExprNode to_node(const Conversion& conversion, Parser::AggregationContext& context) {
    return to_aggregation(conversion, context);
}

ast::ExprNode to_node(const Conversion& conversion, Parser::DiscreteOverContext& context) {
    return to_discrete_over(conversion, context);
}

ast::ExprNode to_node(const Conversion& conversion, Parser::DeterminantContext& context) {
    return ast::Determinant{to_typed_variable(conversion, *context.typedVariable(0)),
                            to_typed_variable(conversion, *context.typedVariable(1)),
                            to_box(conversion, context.expr())};
}

ast::ExprNode to_node(const Conversion& conversion, Parser::DrawContext& context) {
    if (auto* distribution = as<Parser::DrawDistributionContext>(context))
        return to_distribution(conversion, *distribution);
    if (auto* cases = as<Parser::DrawCasesContext>(context))
        return to_discrete_cases(conversion, *cases);
    return to_discrete_over(conversion, *as<Parser::DrawOverContext>(context));
}

// Tries the alternatives one after the other.
template <class First, class... Rest>
ast::ExprNode to_node_of(const Conversion& conversion, Parser::ExprContext& context) {
    if (auto* alternative = as<First>(context)) return to_node(conversion, *alternative);
    if constexpr (sizeof...(Rest) > 0)
        return to_node_of<Rest...>(conversion, context);
    else
        throw std::logic_error("parse: an alternative of 'expr' is not converted");
}

}  // namespace

ast::Expr to_expr(const Conversion& conversion, Parser::ExprContext& context) {
    // The frequent ones first.
    return {to_node_of<Parser::TermExprContext, Parser::BinaryContext, Parser::GroupContext,
                       Parser::IntegerContext, Parser::RealContext, Parser::BooleanContext,
                       Parser::UnaryContext, Parser::IfContext, Parser::AggregationContext,
                       Parser::CallContext, Parser::DistributionContext, Parser::SwitchContext,
                       Parser::DiscreteCasesContext, Parser::DiscreteOverContext,
                       Parser::ExternalContext, Parser::DeterminantContext,
                       Parser::MatrixFunctionContext>(conversion, context),
            span_of(conversion, context)};
}

ast::Expr to_expr(const Conversion& conversion, Parser::RandomVectorContext& context) {
    return {ast::RandomVector{to_name(conversion, context.RANDOM_VECTOR()),
                              to_slot(conversion, *context.slot()),
                              to_vectors(conversion, context.vectorReferences())},
            span_of(conversion, context)};
}

ast::Expr to_expr(const Conversion& conversion, Parser::DrawContext& context) {
    return {to_node(conversion, context), span_of(conversion, context)};
}

}  // namespace rddlc
