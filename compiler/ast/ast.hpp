// The abstract syntax tree: what was written, nothing resolved.
//
// Plain structs in std::variant, each with a Span. Printing a tree gives RDDL again, and
// parse(print(tree)) equals tree up to spans (ast/print.hpp, ast/equal.hpp).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "support/box.hpp"
#include "support/source.hpp"

namespace rddlc::ast {

// A word of the source: an identifier, "?x", "@a" (stored without the mark), an operator's name.
struct Name {
    std::string text;
    Span span;
};

// ---------------------------------------------------------------------------- expressions

struct Expr;
using ExprBox = Box<Expr>;

// "?x : type" in an aggregation.
struct TypedVariable {
    Name variable;  // without "?"
    Name type;
};

struct Boolean {
    bool value;
};
struct Integer {
    std::int64_t value;
};
// `text` keeps the digits as written, for printing.
struct Real {
    double value;
    std::string text;
};
// ?x
struct Variable {
    std::string name;
};
// @a
struct Literal {
    std::string name;
};
// p, p', p(?x), p'(q(?x), @a). A bare name may turn out to be an enumerated value or an object.
struct Reference {
    Name name;
    bool primed = false;
    std::vector<Expr> arguments;  // empty for a bare name
};
// ( e ) or [ e ]
struct Group {
    bool square;
    ExprBox inner;
};

enum class UnaryOperator { Not, Minus, Plus };
struct Unary {
    UnaryOperator op;
    ExprBox operand;
};

enum class BinaryOperator {
    Equivalent, Implies, Or, And,
    Equal, NotEqual, Less, LessEqual, Greater, GreaterEqual,
    Add, Subtract, Multiply, Divide,
};
struct Binary {
    BinaryOperator op;
    Span op_span;
    bool ampersand = false;  // And only: written "&" instead of "^"
    ExprBox left;
    ExprBox right;
};

// name_{ ?x : t, ... } body; any name is accepted here, the checker knows which mean something.
struct Aggregation {
    Name op;
    std::vector<TypedVariable> variables;
    ExprBox body;
};
struct If {
    ExprBox condition;
    ExprBox then_branch;
    ExprBox else_branch;
};
struct SwitchCase {
    std::optional<ExprBox> label;  // a term; absent for "default"
    ExprBox value;
    Span span;
};
struct Switch {
    ExprBox subject;
    std::vector<SwitchCase> cases;
};
// f[a, b]
struct Call {
    Name function;
    std::vector<Expr> arguments;
};
// Normal(m, v) and every other distribution with plain arguments.
struct Distribution {
    Name name;
    std::vector<Expr> arguments;
};
struct LabelledWeight {
    Name label;
    bool at_sign;  // written "@a", not "a"
    ExprBox weight;
};
// Discrete(type, @a : e, ...)
struct DiscreteCases {
    Name name;  // Discrete or UnnormDiscrete
    Name type;
    std::vector<LabelledWeight> weights;
};
// Discrete_{ ?x : t } e
struct DiscreteOver {
    Name name;  // Discrete or UnnormDiscrete
    std::vector<TypedVariable> variables;
    ExprBox weight;
};
// det_{ ?r : t, ?c : t } e
struct Determinant {
    TypedVariable row;
    TypedVariable column;
    ExprBox element;
};
// inverse[row = ?r, col = ?c][e], also pinverse and cholesky
struct MatrixFunction {
    Name name;
    Name row;
    Name column;
    ExprBox element;
};
// "?x", "@a" or "_" as an argument of a vector reference.
struct Slot {
    enum class Kind { Variable, Literal, Underscore } kind;
    Name name;  // empty text for an underscore
};
struct VectorReference {
    Name name;
    std::vector<Slot> slots;
    Span span;
};
// $f[?a, _](p(?a), q)
struct External {
    Name function;
    std::vector<Slot> captured;
    std::vector<VectorReference> arguments;
};
// MultivariateNormal[?x](mean(_), cov(_, _)); only as the whole right-hand side of a CPF.
struct RandomVector {
    Name name;
    Slot axis;
    std::vector<VectorReference> arguments;
};

using ExprNode = std::variant<Boolean, Integer, Real, Variable, Literal, Reference, Group, Unary,
                              Binary, Aggregation, If, Switch, Call, Distribution, DiscreteCases,
                              DiscreteOver, Determinant, MatrixFunction, External, RandomVector>;

struct Expr {
    ExprNode node;
    Span span;
};

// -------------------------------------------------------------------------------- domain

struct TypeDeclaration {
    Name name;
    // Absent for ": object"; the members of an enumerated type otherwise.
    std::optional<std::vector<Name>> members;
    Span span;
};

// A value in a declaration or an instance.
struct PosInf {};
struct NegInf {};
// "@a" or a bare "a"
struct Symbol {
    std::string name;
    bool at_sign;
};
struct Constant {
    std::variant<Boolean, Integer, Real, PosInf, NegInf, Symbol> value;
    Span span;
};

struct PVariable {
    Name name;
    bool primed = false;           // "y'" as a declared name: the checker refuses it
    std::vector<Name> parameters;  // types
    Name kind;                     // "state-fluent", ...
    Name range;                    // "bool", "int", "real" or a type
    std::optional<Constant> default_value;
    std::optional<Constant> level;
    Span span;
};

struct Cpf {
    Name name;
    bool primed = false;
    std::vector<Name> parameters;  // variables, without "?"
    Expr body;
    Span span;
};

struct Requirements {
    std::vector<Name> names;
};
struct Types {
    std::vector<TypeDeclaration> declarations;
};
struct PVariables {
    std::vector<PVariable> declarations;
};
struct Cpfs {
    Name keyword;  // "cpfs" or "cdfs"
    std::vector<Cpf> definitions;
};
struct Reward {
    Expr value;
};
enum class ConstraintKind { Termination, ActionPreconditions, StateActionConstraints, StateInvariants };
struct Constraints {
    ConstraintKind kind;
    std::vector<Expr> conditions;
};

struct DomainName {
    Name name;
};
// A section of a domain, or of a policy, which alone may name its domain.
struct DomainSection {
    std::variant<DomainName, Requirements, Types, PVariables, Cpfs, Reward, Constraints> node;
    Span span;
};
struct Domain {
    Name name;
    std::vector<DomainSection> sections;
    Span span;
};
struct Policy {
    Name name;
    std::vector<DomainSection> sections;
    Span span;
};

// ------------------------------------------------------------------------------ instance

// "p;", "~p(a);", "p(a, @b) = 3;", "p(a) = Normal(0.0, 1.0);"
struct Assignment {
    Name name;
    bool negated = false;
    std::vector<Symbol> arguments;
    std::vector<Span> argument_spans;
    // Absent for the short forms; an expression is a distribution.
    std::optional<std::variant<Constant, ExprBox>> value;
    Span span;
};

struct NonFluentsName {
    Name name;
};
struct ObjectList {
    Name type;
    std::vector<Name> objects;
};
struct Objects {
    std::vector<ObjectList> lists;
};
struct NonFluentValues {
    std::vector<Assignment> assignments;
};
struct InitState {
    std::vector<Assignment> assignments;
};
// Absent value: pos-inf.
struct MaxNondefActions {
    std::optional<std::int64_t> value;
};
struct Horizon {
    std::variant<Integer, PosInf, Expr> value;  // Expr: terminate-when (e)
};
struct Discount {
    std::variant<Integer, Real> value;
};

struct InstanceSection {
    std::variant<DomainName, NonFluentsName, Objects, NonFluentValues, InitState, MaxNondefActions,
                 Horizon, Discount>
        node;
    Span span;
};
struct NonFluents {
    Name name;
    std::vector<InstanceSection> sections;  // DomainName, Objects, NonFluentValues only
    Span span;
};
struct Instance {
    Name name;
    std::vector<InstanceSection> sections;
    Span span;
};

using Block = std::variant<Domain, NonFluents, Instance, Policy>;

// Everything that was read, domain file first.
struct Program {
    std::vector<Block> blocks;
};

}  // namespace rddlc::ast
