#include "model/vocabulary.hpp"

#include <array>
#include <cstddef>

namespace rddlc {
namespace {

constexpr std::array role_names = {
    std::string_view{"non-fluent"},     std::string_view{"state-fluent"},
    std::string_view{"action-fluent"},  std::string_view{"interm-fluent"},
    std::string_view{"derived-fluent"}, std::string_view{"observ-fluent"},
};

// One row an operator, in the order of the enumeration.
struct OperatorRow {
    Operator op;
    std::string_view name;    // in printed models and IR
    std::string_view source;  // in RDDL
    int arity;
    bool function;  // written source[...]
};

constexpr OperatorRow operators[] = {
    {Operator::Add, "add", "+", 2, false},
    {Operator::Subtract, "subtract", "-", 2, false},
    {Operator::Multiply, "multiply", "*", 2, false},
    {Operator::Negate, "negate", "-", 1, false},
    {Operator::Divide, "divide", "/", 2, false},
    {Operator::FloorDivide, "floor_div", "div", 2, true},
    {Operator::FloorModulo, "floor_mod", "mod", 2, true},
    {Operator::Equal, "equal", "==", 2, false},
    {Operator::NotEqual, "not_equal", "~=", 2, false},
    {Operator::Less, "less", "<", 2, false},
    {Operator::LessEqual, "less_equal", "<=", 2, false},
    {Operator::Greater, "greater", ">", 2, false},
    {Operator::GreaterEqual, "greater_equal", ">=", 2, false},
    {Operator::And, "and", "^", 2, false},
    {Operator::Or, "or", "|", 2, false},
    {Operator::Not, "not", "~", 1, false},
    {Operator::Implies, "implies", "=>", 2, false},
    {Operator::Equivalent, "equivalent", "<=>", 2, false},
    {Operator::Abs, "absolute", "abs", 1, true},
    {Operator::Sign, "sign", "sgn", 1, true},
    {Operator::Round, "round", "round", 1, true},
    {Operator::Floor, "floor", "floor", 1, true},
    {Operator::Ceil, "ceil", "ceil", 1, true},
    {Operator::Minimum, "minimum", "min", 2, true},
    {Operator::Maximum, "maximum", "max", 2, true},
    {Operator::FloorModuloReal, "floor_mod_real", "fmod", 2, true},
    {Operator::Power, "power", "pow", 2, true},
    {Operator::Exp, "exp", "exp", 1, true},
    {Operator::Ln, "ln", "ln", 1, true},
    {Operator::Sqrt, "sqrt", "sqrt", 1, true},
    {Operator::Cos, "cos", "cos", 1, true},
    {Operator::Sin, "sin", "sin", 1, true},
    {Operator::Tan, "tan", "tan", 1, true},
    {Operator::Acos, "acos", "acos", 1, true},
    {Operator::Asin, "asin", "asin", 1, true},
    {Operator::Atan, "atan", "atan", 1, true},
    {Operator::Cosh, "cosh", "cosh", 1, true},
    {Operator::Sinh, "sinh", "sinh", 1, true},
    {Operator::Tanh, "tanh", "tanh", 1, true},
    {Operator::Log, "log", "log", 2, true},
    {Operator::Hypot, "hypot", "hypot", 2, true},
    {Operator::Atan2, "atan2", "atan2", 2, true},
    {Operator::LnGamma, "ln_gamma", "lngamma", 1, true},
    {Operator::Gamma, "gamma", "gamma", 1, true},
    {Operator::Defined, "defined", "", 1, false},
    {Operator::BitAnd, "bit_and", "", 2, false},
    {Operator::BitOr, "bit_or", "", 2, false},
    {Operator::BitXor, "bit_xor", "", 2, false},
    {Operator::CountOnes, "count_ones", "", 1, false},
};

struct ReductionRow {
    Reduction reduction;
    std::string_view name;
};

constexpr ReductionRow reductions[] = {
    {Reduction::Sum, "sum"},       {Reduction::Product, "prod"},  {Reduction::Average, "avg"},
    {Reduction::Minimum, "min"},   {Reduction::Maximum, "max"},   {Reduction::ForAll, "forall"},
    {Reduction::Exists, "exists"}, {Reduction::ArgMin, "argmin"}, {Reduction::ArgMax, "argmax"},
};

struct DistributionRow {
    Distribution distribution;
    std::string_view name;
    int arity;
};

constexpr DistributionRow distributions[] = {
    {Distribution::KronDelta, "KronDelta", 1},
    {Distribution::DiracDelta, "DiracDelta", 1},
    {Distribution::Bernoulli, "Bernoulli", 1},
    {Distribution::Uniform, "Uniform", 2},
    {Distribution::Normal, "Normal", 2},
    {Distribution::Poisson, "Poisson", 1},
    {Distribution::Exponential, "Exponential", 1},
    {Distribution::Weibull, "Weibull", 2},
    {Distribution::Gamma, "Gamma", 2},
    {Distribution::Binomial, "Binomial", 2},
    {Distribution::NegativeBinomial, "NegativeBinomial", 2},
    {Distribution::Beta, "Beta", 2},
    {Distribution::Geometric, "Geometric", 1},
    {Distribution::Pareto, "Pareto", 2},
    {Distribution::Student, "Student", 1},
    {Distribution::Gumbel, "Gumbel", 2},
    {Distribution::Laplace, "Laplace", 2},
    {Distribution::Cauchy, "Cauchy", 2},
    {Distribution::Gompertz, "Gompertz", 2},
    {Distribution::ChiSquare, "ChiSquare", 1},
    {Distribution::Kumaraswamy, "Kumaraswamy", 2},
};

// A table's row is found by the enumerator's number, so the orders have to agree.
consteval bool in_order() {
    for (std::size_t i = 0; i < std::size(operators); ++i)
        if (operators[i].op != static_cast<Operator>(i)) return false;
    for (std::size_t i = 0; i < std::size(reductions); ++i)
        if (reductions[i].reduction != static_cast<Reduction>(i)) return false;
    for (std::size_t i = 0; i < std::size(distributions); ++i)
        if (distributions[i].distribution != static_cast<Distribution>(i)) return false;
    return true;
}
static_assert(in_order());

const OperatorRow& row(Operator op) {
    return operators[static_cast<std::size_t>(op)];
}
const DistributionRow& row(Distribution distribution) {
    return distributions[static_cast<std::size_t>(distribution)];
}

}  // namespace

std::string_view name_of(Role role) {
    return role_names[static_cast<std::size_t>(role)];
}
std::string_view name_of(Operator op) {
    return row(op).name;
}
std::string_view source_name_of(Operator op) {
    return row(op).source;
}
std::string_view name_of(Reduction reduction) {
    return reductions[static_cast<std::size_t>(reduction)].name;
}
std::string_view name_of(Distribution distribution) {
    return row(distribution).name;
}
std::string_view name_of(MatrixOperator op) {
    constexpr std::string_view names[] = {"det", "inverse", "pinverse", "cholesky"};
    return names[static_cast<std::size_t>(op)];
}
std::string_view name_of(VectorDistribution distribution) {
    constexpr std::string_view names[] = {"MultivariateNormal", "MultivariateStudent", "Dirichlet",
                                          "Multinomial"};
    return names[static_cast<std::size_t>(distribution)];
}

int arity_of(Operator op) {
    return row(op).arity;
}
bool is_function(Operator op) {
    return row(op).function;
}
int arity_of(Distribution distribution) {
    return row(distribution).arity;
}

bool is_extension(Operator op) {
    return op == Operator::Atan2;
}

bool is_comparison(Operator op) {
    return op >= Operator::Equal && op <= Operator::GreaterEqual;
}

bool is_order(Operator op) {
    return op >= Operator::Less && op <= Operator::GreaterEqual;
}

Operator mirrored(Operator op) {
    switch (op) {
        case Operator::Less:
            return Operator::Greater;
        case Operator::LessEqual:
            return Operator::GreaterEqual;
        case Operator::Greater:
            return Operator::Less;
        case Operator::GreaterEqual:
            return Operator::LessEqual;
        default:
            return op;
    }
}

bool may_fault(Operator op, bool on_integers) {
    return (op == Operator::Power && on_integers) || op == Operator::LnGamma ||
           op == Operator::Gamma || op == Operator::Defined;
}

std::optional<Role> role_named(std::string_view name) {
    for (std::size_t i = 0; i < role_names.size(); ++i)
        if (role_names[i] == name) return static_cast<Role>(i);
    return std::nullopt;
}

std::optional<Reduction> reduction_named(std::string_view name) {
    for (const ReductionRow& candidate : reductions)
        if (candidate.name == name) return candidate.reduction;
    return std::nullopt;
}

std::optional<Distribution> distribution_named(std::string_view name) {
    for (const DistributionRow& candidate : distributions)
        if (candidate.name == name) return candidate.distribution;
    return std::nullopt;
}

std::optional<Operator> function_named(std::string_view name) {
    for (const OperatorRow& candidate : operators)
        if (candidate.function && candidate.source == name) return candidate.op;
    return std::nullopt;
}

std::vector<std::string> function_names() {
    std::vector<std::string> names;
    for (const OperatorRow& candidate : operators)
        if (candidate.function) names.emplace_back(candidate.source);
    return names;
}

std::vector<std::string> reduction_names() {
    std::vector<std::string> names;
    for (const ReductionRow& candidate : reductions) names.emplace_back(candidate.name);
    return names;
}

}  // namespace rddlc
