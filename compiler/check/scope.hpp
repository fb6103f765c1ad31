// The names that are visible at a place of an expression, and those that the expression has used so
// far.
#pragma once

#include "check/context.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rddlc::checking {

struct Binding {
    std::string name;  // without "?"
    // Absent if the type was wrong: what uses the variable is not reported again.
    std::optional<model::VariableId> variable;
    Span span;
};
// A variable whose aggregation is over.
struct EndedBinding {
    std::string name;
    std::string binder;  // "sum"
    Span span;           // the whole aggregation
};
struct FluentUse {
    model::FluentId fluent;
    bool next;
    Span span;
};
struct VariableUse {
    model::VariableId variable;
    Span span;
};
// An aggregation with the operators that end in it, from the innermost on.
struct CheckedAggregation {
    const ast::Expr* whole;
    std::vector<const ast::Expr*> left;
    std::vector<model::VariableId> variables;
};

// One for each CPF, condition and reward.
struct Scope {
    Context& context;
    std::vector<Binding> bindings = {};  // outermost first
    std::vector<EndedBinding> ended = {};
    std::vector<FluentUse> fluent_uses = {};
    std::vector<VariableUse> variable_uses = {};
    std::vector<Span> draws = {};
    std::vector<CheckedAggregation> aggregations = {};
    // The expression that is being checked, with everything around it, outermost first.
    std::vector<const ast::Expr*> path = {};
    std::optional<model::TypeId> range = {};  // an enumerated type that the whole is of
    bool may_name_objects = false;            // those of the instance: in its own expressions
};

// Brings a variable into scope; reported if the name is in scope already.
std::optional<model::VariableId> bind(const ast::Name& name, std::optional<model::TypeId> type,
                                      Scope& scope);

// The variables of an aggregation, in scope as long as the binder lives.
class Binder {
  public:
    // `what` is the aggregation's name, `whole` its place.
    Binder(const std::vector<ast::TypedVariable>& variables, std::string_view what, Span whole,
           Scope& scope);
    ~Binder();
    Binder(const Binder&) = delete;
    Binder& operator=(const Binder&) = delete;

    // Nothing if a type is unknown or a name is taken.
    std::optional<std::vector<model::VariableId>> variables() const;

  private:
    Scope& scope_;
    std::size_t outer_;  // bindings before
    std::string what_;
    Span whole_;
    std::vector<std::optional<model::VariableId>> variables_;
};

// The variable of that name; reported if it is not in scope. Also nothing if its type was wrong.
std::optional<model::VariableId> resolve_variable(const std::string& name, Span span, Scope& scope);

}  // namespace rddlc::checking
