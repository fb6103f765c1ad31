// RDDL's vocabulary: roles, operators, aggregations and distributions, shared by all stages. Each
// word is a row of one table, operators.cpp or distributions.cpp among them, and all that is
// particular to it stands in that row (CONTRIBUTING.md walks through it).
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc {

enum class Role : std::uint8_t { NonFluent, State, Action, Interm, Derived, Observ };

// Scalar operators. Operand and result types are explicit: `Convert` nodes stand where RDDL
// promotes bool -> int -> real, so `Add` on ints is an integer addition, on reals a real one.
enum class Operator : std::uint8_t {
    // arithmetic
    Add,
    Subtract,
    Multiply,
    Negate,
    Divide,  // x/0 is inf or nan, never a fault
    FloorDivide,
    FloorModulo,  // div, mod: toward -inf; by 0 gives 0
    // comparisons
    Equal,
    NotEqual,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    // logic
    And,
    Or,
    Not,
    Implies,
    Equivalent,
    // functions
    Abs,
    Sign,
    Round,
    Floor,
    Ceil,
    Minimum,
    Maximum,          // nan wins
    FloorModuloReal,  // fmod: sign of the divisor (also on ints: FloorModulo)
    Power,            // of ints: a negative exponent is a fault
    Exp,
    Ln,
    Sqrt,
    Cos,
    Sin,
    Tan,
    Acos,
    Asin,
    Atan,
    Cosh,
    Sinh,
    Tanh,
    Log,  // log[x, base]
    Hypot,
    Atan2,  // atan2[y, x]
    LnGamma,
    Gamma,  // fault unless the operand is > 0
    // not in RDDL
    Defined,  // faults on nan
    BitAnd,
    BitOr,
    BitXor,
    ShiftRight,
    CountOnes,  // of ints, bit by bit; how many bits are 1
};

// Which types an operator takes and gives. All operands are of one type.
enum class Typing : std::uint8_t {
    Equality,  // any type, to bool
    Order,     // ints or reals, to bool
    Logic,     // bools, to bool
    Numbers,   // ints or reals, to the same type
    Ints,      // ints, to int
    Reals,     // reals, to real
    Rounding,  // reals, to int
    Sign,      // ints or reals, to int
};

enum class Reduction : std::uint8_t {
    Sum,
    Product,
    Average,
    Minimum,
    Maximum,
    ForAll,
    Exists,
    ArgMin,
    ArgMax,
};
constexpr bool is_quantifier(Reduction op) {
    return op == Reduction::ForAll || op == Reduction::Exists;
}

// Distributions with plain parameters; Discrete has nodes of its own.
enum class Distribution : std::uint8_t {
    KronDelta,
    DiracDelta,
    Bernoulli,
    Uniform,
    Normal,
    Poisson,
    Exponential,
    Weibull,
    Gamma,
    Binomial,
    NegativeBinomial,
    Beta,
    Geometric,
    Pareto,
    Student,
    Gumbel,
    Laplace,
    Cauchy,
    Gompertz,
    ChiSquare,
    Kumaraswamy,
};

// Random variables. The deltas give a value of the type of their parameter.
enum class Drawn : std::uint8_t { Bool, Int, Real, AsGiven };

// Functions of a whole matrix. Determinant is written det_{...}, the others name[row=, col=][...].
enum class MatrixOperator : std::uint8_t { Determinant, Inverse, PseudoInverse, Cholesky };

// Draws of a whole vector, written Name[?x](...).
enum class VectorDistribution : std::uint8_t {
    MultivariateNormal,
    MultivariateStudent,
    Dirichlet,
    Multinomial,
};

// if (is_one_of(op, {Operator::Add, Operator::Subtract})) ...
template <class Enumerator>
constexpr bool is_one_of(Enumerator value, std::initializer_list<Enumerator> set) {
    for (const Enumerator each : set)
        if (each == value) return true;
    return false;
}

// "state-fluent", ...
std::string_view name_of(Role role);

// The name in printed models and IR, e.g. "add", "floor_div"; and in RDDL source, e.g. "+", "div".
std::string_view name_of(Operator op);
std::string_view source_name_of(Operator op);
std::string_view name_of(Reduction reduction);              // as in RDDL: "sum", "forall", ...
std::string_view name_of(Distribution distribution);        // as in RDDL: "Normal", ...
std::string_view name_of(MatrixOperator op);                // as in RDDL: "det", "inverse", ...
std::string_view name_of(VectorDistribution distribution);  // as in RDDL: "Dirichlet", ...

// How it is written, with the names of its parameters: "log[x, base]", "Normal(mean, variance)".
std::string form_of(Operator function);
std::string form_of(Distribution distribution);

std::size_t arity_of(Operator op);
Typing typing_of(Operator op);
// The operator that is meant where operands are ints and the result must be one; nothing if there
// is no such operator.
std::optional<Operator> on_ints(Operator op);
// Written name[...] in RDDL, unlike the infix and prefix operators.
bool is_function(Operator op);
// Functions that only --std=rddlc has.
bool is_extension(Operator op);
// Computed by many operations, as logarithms are.
bool is_elementary(Operator op);
// True for operators that fault on some operands.
bool may_fault(Operator op, bool on_integers);

// Equal to GreaterEqual.
bool is_comparison(Operator op);
// Less to GreaterEqual.
bool is_order(Operator op);
// The mirrored comparison: `a op b` is `b mirrored(op) a`.
Operator mirrored(Operator op);

std::size_t arity_of(Distribution distribution);
bool takes_int(Distribution distribution, std::size_t parameter);
Drawn drawn_by(Distribution distribution);
// KronDelta and DiracDelta, which give their parameter.
bool is_delta(Distribution distribution);
// Drawn from one uniform number, by functions that vector registers have.
bool is_by_inversion(Distribution distribution);
// Distributions that only --std=rddlc has. Their names are not reserved: fluents and objects may
// have them.
bool is_extension(Distribution distribution);

std::optional<Role> role_named(std::string_view name);
std::optional<Reduction> reduction_named(std::string_view name);
std::optional<Distribution> distribution_named(std::string_view name);
// Functions called with square brackets: f[...]. "abs", "div", "pow", ...
std::optional<Operator> function_named(std::string_view name);

// All of them, to suggest a near name.
std::vector<std::string> function_names();
std::vector<std::string> reduction_names();
std::vector<std::string> distribution_names();

}  // namespace rddlc
