// RDDL's vocabulary: roles, operators, aggregations and distributions, shared by model and IR.
// One table row each: to add one, add a row here, its meaning in runtime/rddl/, and follow the
// compiler's complaints (CONTRIBUTING.md walks through it).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc {

enum class Role : std::uint8_t { NonFluent, State, Action, Interm, Derived, Observ };

// Scalar operators. Operand and result types are explicit: `Convert` nodes stand where RDDL
// promotes bool -> int -> real, so `Add` on ints is an integer addition, on reals a real one.
enum class Operator : std::uint8_t {
    // arithmetic: int x int -> int or real x real -> real
    Add, Subtract, Multiply, Negate,
    Divide,                 // real x real -> real; x/0 is inf or nan, never a fault
    // integer arithmetic
    FloorDivide, FloorModulo,  // div, mod: toward -inf; by 0 gives 0
    // comparisons: both operands of one type -> bool
    Equal, NotEqual, Less, LessEqual, Greater, GreaterEqual,
    // logic: bool -> bool
    And, Or, Not, Implies, Equivalent,
    // functions
    Abs, Sign, Round, Floor, Ceil,            // Sign..Ceil: real -> int (Sign and Abs: int -> int too)
    Minimum, Maximum,                         // int or real, two operands, nan wins
    FloorModuloReal,                          // fmod: sign of the divisor (also on ints: FloorModulo)
    Power,                                    // int^int -> int (negative exponent: fault), else real
    Exp, Ln, Sqrt, Cos, Sin, Tan, Acos, Asin, Atan, Cosh, Sinh, Tanh,
    Log,                                      // log[x, base]
    Hypot,
    Atan2,                                    // atan2[y, x], an extension
    LnGamma, Gamma,                           // fault unless the operand is > 0
    // not in RDDL
    Defined,                                  // real -> real, faults on nan
    BitAnd, BitOr, BitXor, CountOnes,         // of ints, bit by bit; how many bits are 1
};

enum class Reduction : std::uint8_t {
    Sum, Product, Average, Minimum, Maximum, ForAll, Exists, ArgMin, ArgMax,
};

// Distributions with plain parameters; Discrete has nodes of its own.
enum class Distribution : std::uint8_t {
    KronDelta, DiracDelta, Bernoulli, Uniform, Normal, Poisson, Exponential, Weibull, Gamma,
    Binomial, NegativeBinomial, Beta, Geometric, Pareto, Student, Gumbel, Laplace, Cauchy,
    Gompertz, ChiSquare, Kumaraswamy,
};

// Functions of a whole matrix. Determinant is written det_{...}, the others name[row=, col=][...].
enum class MatrixOperator : std::uint8_t { Determinant, Inverse, PseudoInverse, Cholesky };

// Draws of a whole vector, written Name[?x](...).
enum class VectorDistribution : std::uint8_t {
    MultivariateNormal, MultivariateStudent, Dirichlet, Multinomial,
};

// "state-fluent", ...
std::string_view name_of(Role role);

// The name in printed models and IR, e.g. "add", "floor_div"; and in RDDL source, e.g. "+", "div".
std::string_view name_of(Operator op);
std::string_view source_name_of(Operator op);
std::string_view name_of(Reduction reduction);        // as in RDDL: "sum", "forall", ...
std::string_view name_of(Distribution distribution);  // as in RDDL: "Normal", ...
std::string_view name_of(MatrixOperator op);          // as in RDDL: "det", "inverse", ...
std::string_view name_of(VectorDistribution distribution);  // as in RDDL: "Dirichlet", ...

int arity_of(Operator op);
// Written name[...] in RDDL, unlike the infix and prefix operators.
bool is_function(Operator op);
int arity_of(Distribution distribution);

// Functions that only --std=rddlc has.
bool is_extension(Operator op);

// Equal to GreaterEqual.
bool is_comparison(Operator op);
// Less to GreaterEqual.
bool is_order(Operator op);
// The mirrored comparison: `a op b` is `b mirrored(op) a`.
Operator mirrored(Operator op);

// True for operators that fault on some operands: Power on ints, LnGamma, Gamma, Defined.
bool may_fault(Operator op, bool on_integers);

std::optional<Role> role_named(std::string_view name);
std::optional<Reduction> reduction_named(std::string_view name);
std::optional<Distribution> distribution_named(std::string_view name);
// Functions called with square brackets: f[...]. "abs", "div", "pow", ...
std::optional<Operator> function_named(std::string_view name);

// All of them, to suggest a near name.
std::vector<std::string> function_names();
std::vector<std::string> reduction_names();

}  // namespace rddlc
