// The checked model: names resolved and numbered, expressions typed, casts explicit.
//
// Nothing here can fail any more except at run time; later stages assert instead of diagnosing
// (apart from "valid RDDL, not supported yet", which ground/ reports).
#pragma once

#include "model/table.hpp"
#include "support/box.hpp"
#include "support/source.hpp"
#include "vocabulary/vocabulary.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace rddlc::model {

using TypeId = std::uint32_t;      // index into Model::types
using FluentId = std::uint32_t;    // index into Model::fluents
using VariableId = std::uint32_t;  // index into Model::variables

// An object type or an enumerated type. An object is its index in `objects`.
struct Type {
    std::string name;
    bool enumerated = false;
    std::vector<std::string> objects;  // without "@"
    Span span;
};

struct ValueType {
    enum class Kind : std::uint8_t { Bool, Int, Real, Object } kind;
    TypeId type = 0;  // for Object: which

    bool operator==(const ValueType&) const = default;
};
inline constexpr ValueType bool_type{ValueType::Kind::Bool};
inline constexpr ValueType int_type{ValueType::Kind::Int};
inline constexpr ValueType real_type{ValueType::Kind::Real};

// Objects are held as int64 indices.
using Value = rddlc::Value;

struct Fluent {
    std::string name;
    Role role;
    std::vector<TypeId> parameters;
    ValueType range;
    std::optional<Value> default_value;
    Span span;
    // Non-fluents: the instance's values; state-fluents: initial values, or anything where
    // Model::initial_draws has one; action-fluents: the
    // default for every grounding; others: empty. Row-major over the parameters' objects, each
    // already of the range's type (bool, int64 or double).
    Table values;
};

// A parameter of a CPF or a variable of an aggregation. Every binder has a variable of its own.
struct Variable {
    std::string name;  // without "?"
    TypeId type;
    Span span;
};

// ---------------------------------------------------------------------------- expressions

struct Expr;
using ExprBox = Box<Expr>;

struct Constant {  // also object and enumerated literals, as int64 with an Object type
    Value value;
};
struct VariableValue {  // ?x as a value
    VariableId variable;
};
struct Reference {
    FluentId fluent;
    bool next = false;            // primed
    std::vector<Expr> arguments;  // one per parameter, each of exactly the parameter's Object type
};
// bool -> int, bool -> real or int -> real, to Expr::type.
struct Convert {
    ExprBox operand;
};
// A value that RDDL's typing forbids here, on a path that need not be taken: faults when evaluated.
// Reported as a warning by the checker.
struct TypeFault {
    std::string message;  // "'2.5' is real, 'x' is int"
};
struct Apply {
    Operator op;
    std::vector<Expr> operands;
};
struct If {  // lazy: only the branch taken is evaluated
    ExprBox condition, then_branch, else_branch;
};
struct Switch {
    ExprBox subject;                            // of an enumerated type
    std::vector<std::optional<ExprBox>> cases;  // one per member, absent: default
    std::optional<ExprBox> default_case;
};
struct Aggregate {
    Reduction op;
    std::vector<VariableId> variables;
    ExprBox body;
};
struct Sample {
    Distribution distribution;
    std::vector<Expr> parameters;
};
// Discrete(type, ...): one weight per member, in member order.
struct Discrete {
    bool normalise;  // UnnormDiscrete
    TypeId type;
    std::vector<Expr> weights;
};
// Discrete_{?x : t} weight
struct DiscreteOver {
    bool normalise;
    VariableId variable;
    ExprBox weight;
};
struct Determinant {
    VariableId row, column;
    ExprBox element;
};
struct MatrixFunction {
    MatrixOperator op;       // not Determinant
    VariableId row, column;  // bound by the enclosing scope
    ExprBox element;
};
// An argument of a vector reference: the vector axis, a variable in scope, or a fixed object.
struct Axis {};
using Slot = std::variant<Axis, VariableId, std::int64_t>;
struct VectorReference {
    FluentId fluent;
    bool next = false;
    std::vector<Slot> slots;  // one per parameter
};
struct External {
    std::string function;
    std::vector<VariableId> captured;
    std::vector<VectorReference> arguments;
};
struct RandomVector {
    VectorDistribution distribution;
    VariableId axis;  // a parameter of the CPF
    std::vector<VectorReference> arguments;
};

using ExprNode = std::variant<Constant, VariableValue, Reference, Convert, TypeFault, Apply, If,
                              Switch, Aggregate, Sample, Discrete, DiscreteOver, Determinant,
                              MatrixFunction, External, RandomVector>;

struct Expr {
    ValueType type;
    Span span;
    ExprNode node;
};

struct Cpf {
    FluentId fluent;  // for a state-fluent: defines its next value
    std::vector<VariableId> parameters;
    Expr body;  // of exactly the fluent's range
    Span span;
};

// A policy block: how to choose the action. It declares state-fluents (its memory), derived-fluents
// and non-fluents, among which param-fluents are.
struct Policy {
    std::string name;
    FluentId first_fluent;  // from there on, Model::fluents are the policy's own
    std::vector<Cpf> cpfs;  // of the action-fluents and of its own, in evaluation order
    Span span;              // of its name
};

// A random initial value of one grounding of a state-fluent.
struct InitialDraw {
    FluentId fluent;
    std::vector<std::int64_t> objects;  // one for each parameter
    Expr value;                         // of exactly the fluent's range; reads non-fluents only
    Span span;
};

struct Model {
    std::string domain_name;
    std::string instance_name;

    std::vector<Type> types;
    std::vector<Fluent> fluents;  // in declaration order, the domain's before the policy's
    std::vector<Variable> variables;

    std::vector<InitialDraw> initial_draws;  // of different groundings, in the order written
    std::vector<Cpf> cpfs;                   // in evaluation order (Semantics 4.6)
    Expr reward;                             // real
    // Each of type bool. State-action constraints are not kept: nothing enforces them.
    std::vector<Expr> action_preconditions;
    std::vector<Expr> state_invariants;
    std::vector<Expr> terminations;

    std::int64_t horizon = 0;  // 0: no horizon (pos-inf)
    double discount = 1.0;
    std::optional<std::int64_t> max_nondef_actions;  // absent: no limit (pos-inf)

    std::optional<Policy> policy;

    std::span<const Fluent> domain_fluents() const;
    std::span<const Fluent> policy_fluents() const;
    bool is_of_policy(FluentId id) const { return policy && id >= policy->first_fluent; }
    const Type& type_of(const Variable& variable) const { return types[variable.type]; }
    // The number of groundings: the product of the parameter types' sizes.
    std::int64_t grounding_count(const Fluent& fluent) const;
};

}  // namespace rddlc::model
