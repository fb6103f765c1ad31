// Expressions: one function for each form, in the files named beside them.
#pragma once

#include "check/casts.hpp"
#include "check/scope.hpp"

namespace rddlc::checking {

// Everything is reported; nothing is returned if a part was wrong.
Typed check_expression(const ast::Expr& expression, Scope& scope);

// The expression without the brackets around it.
const ast::Expr& without_groups(const ast::Expr& expression);

// references.cpp
Typed check_variable(const ast::Variable& variable, Span span, Scope& scope);
Typed check_literal(const ast::Literal& literal, Span span, Scope& scope);
Typed check_reference(const ast::Reference& reference, Span span, Scope& scope);
// The fluent that is referred to, with so many arguments; the arguments are not checked.
std::optional<model::FluentId> check_fluent(const ast::Reference& reference,
                                            std::size_t argument_count, Span span, Scope& scope);

// operators.cpp
Typed check_unary(const ast::Unary& unary, Span span, Scope& scope);
Typed check_binary(const ast::Binary& binary, Span span, Scope& scope);

// calls.cpp
Typed check_call(const ast::Call& call, Span span, Scope& scope);
Typed check_distribution(const ast::Distribution& distribution, Span span, Scope& scope);

// control.cpp
Typed check_if(const ast::If& conditional, Span span, Scope& scope);
Typed check_switch(const ast::Switch& choice, Span span, Scope& scope);
Typed check_discrete(const ast::DiscreteCases& discrete, Span span, Scope& scope);

// aggregations.cpp
Typed check_aggregation(const ast::Aggregation& aggregation, Span span, Scope& scope);
Typed check_discrete_over(const ast::DiscreteOver& discrete, Span span, Scope& scope);
Typed check_determinant(const ast::Determinant& determinant, Span span, Scope& scope);

// vectors.cpp
bool check_square(std::string_view function, model::VariableId row, model::VariableId column,
                  Span span, Context& context);
Typed check_matrix_function(const ast::MatrixFunction& function, Span span, Scope& scope);
Typed check_external(const ast::External& external, Span span, Scope& scope);
// Accepts them only as the whole right-hand side of a CPF, whose parameters are all that is in
// scope.
Typed check_random_vector(const ast::RandomVector& vector, Span span, Scope& scope);

}  // namespace rddlc::checking
