// The operators of RDDL and of the IR, and all that is particular to each.
#include "vocabulary/kernels.hpp"
#include "vocabulary/range.hpp"

#include <rddl/values/bits.hpp>
#include <rddl/values/linear_algebra.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace rddlc {
namespace {

enum class Form : std::uint8_t {
    Infix,
    Prefix,
    Function,   // name[...]
    Extension,  // a function that only --std=rddlc has
    Internal,   // not in RDDL
};

enum class Faults : std::uint8_t { Never, OnInts, Always };

struct OperatorRow {
    Operator op;
    std::string_view name;    // in printed models and IR, and that of the runtime's function
    std::string_view source;  // in RDDL
    Form form;
    std::array<std::string_view, 2>
        operands;  // their names; the second is empty if there is one only
    Typing typing;
    OperatorKernels kernels;
    RangeRule range = nullptr;  // of reals; null: unknown
    Faults faults = Faults::Never;
    bool elementary = false;
    std::optional<Operator> of_ints = {};  // if ints are computed by another operator
};

using Ints = Operands<std::int64_t>;
using Reals = Operands<double>;

bool is_whole_number(double value) {
    return value == std::floor(value);
}

std::optional<Range> product(Range a, Range b) {
    return hull({a.lower * b.lower, a.lower * b.upper, a.upper * b.lower, a.upper * b.upper});
}

// A zero in the divisor makes nan possible.
std::optional<Range> quotient(Range a, Range b) {
    if (!excludes_zero(b)) return std::nullopt;
    return hull({a.lower / b.lower, a.lower / b.upper, a.upper / b.lower, a.upper / b.upper});
}

// The remainder has the divisor's sign.
std::optional<Range> remainder(Range, Range divisor) {
    if (divisor.lower <= 0 && divisor.upper >= 0) return std::nullopt;
    return Range{std::min(0.0, divisor.lower), std::max(0.0, divisor.upper)};
}

// Whole exponents, and any exponent of what is not negative.
std::optional<Range> power(Range base, Range exponent) {
    if (exponent.lower < 0) return std::nullopt;
    const bool is_whole = exponent.lower == exponent.upper && is_whole_number(exponent.lower);
    if (!is_whole && base.lower < 0) return std::nullopt;
    const double most = std::pow(std::max(magnitude(base), 1.0), exponent.upper);
    const bool is_even = is_whole && std::fmod(exponent.lower, 2) == 0;
    return padded(base.lower >= 0 || is_even ? Range{0, most} : symmetric(most));
}

std::optional<Range> unit(Range, Range) {
    return padded({-1, 1});
}

std::optional<Range> angle(Range, Range) {
    return symmetric(4);
}

std::optional<Range> angle_of_unit(Range a, Range) {
    return magnitude(a) > 1 ? std::nullopt : std::optional(symmetric(4));
}

std::optional<Range> hyperbolic(Range a, Range) {
    return padded(symmetric(std::cosh(magnitude(a))));
}

std::optional<Range> tangent(Range, Range) {
    return symmetric(1e20);  // no double is nearer to a pole
}

// clang-format off
// In the order of the enumeration.
constexpr OperatorRow operators[] = {
    {.op = Operator::Add, .name = "add", .source = "+", .form = Form::Infix, .operands = {"a", "b"},
     .typing = Typing::Numbers,
     .kernels = {.of_ints = [](const Ints& x) { return rddl::wrap_add(x.a, x.b); },
                 .of_reals = [](const Reals& x) { return x.a + x.b; }},
     .range = [](Range a, Range b) { return hull({a.lower + b.lower, a.upper + b.upper}); }},
    {.op = Operator::Subtract, .name = "subtract", .source = "-", .form = Form::Infix, .operands = {"a", "b"},
     .typing = Typing::Numbers,
     .kernels = {.of_ints = [](const Ints& x) { return rddl::wrap_sub(x.a, x.b); },
                 .of_reals = [](const Reals& x) { return x.a - x.b; }},
     .range = [](Range a, Range b) { return hull({a.lower - b.upper, a.upper - b.lower}); }},
    {.op = Operator::Multiply, .name = "multiply", .source = "*", .form = Form::Infix, .operands = {"a", "b"},
     .typing = Typing::Numbers,
     .kernels = {.of_ints = [](const Ints& x) { return rddl::wrap_mul(x.a, x.b); },
                 .of_reals = [](const Reals& x) { return x.a * x.b; }},
     .range = product},
    {.op = Operator::Negate, .name = "negate", .source = "-", .form = Form::Prefix, .operands = {"a"},
     .typing = Typing::Numbers,
     .kernels = {.of_ints = [](const Ints& x) { return rddl::wrap_neg(x.a); },
                 .of_reals = [](const Reals& x) { return -x.a; }},
     .range = [](Range a, Range) { return std::optional(Range{-a.upper, -a.lower}); }},
    {.op = Operator::Divide, .name = "divide", .source = "/", .form = Form::Infix, .operands = {"a", "b"},
     .typing = Typing::Reals,
     .kernels = {.of_reals = [](const Reals& x) { return x.a / x.b; }},
     .range = quotient},
    {.op = Operator::FloorDivide, .name = "floor_div", .source = "div", .form = Form::Function,
     .operands = {"dividend", "divisor"}, .typing = Typing::Ints,
     .kernels = {.of_ints = [](const Ints& x) { return rddl::floor_div(x.a, x.b); }}},
    {.op = Operator::FloorModulo, .name = "floor_mod", .source = "mod", .form = Form::Function,
     .operands = {"dividend", "divisor"}, .typing = Typing::Ints,
     .kernels = {.of_ints = [](const Ints& x) { return rddl::floor_mod(x.a, x.b); }}},

    {.op = Operator::Equal, .name = "equal", .source = "==", .form = Form::Infix, .operands = {"a", "b"},
     .typing = Typing::Equality, .kernels = {.of_bools = [](bool a, bool b) { return a == b; }}},
    {.op = Operator::NotEqual, .name = "not_equal", .source = "~=", .form = Form::Infix, .operands = {"a", "b"},
     .typing = Typing::Equality, .kernels = {.of_bools = [](bool a, bool b) { return a != b; }}},
    {.op = Operator::Less, .name = "less", .source = "<", .form = Form::Infix, .operands = {"a", "b"},
     .typing = Typing::Order, .kernels = {}},
    {.op = Operator::LessEqual, .name = "less_equal", .source = "<=", .form = Form::Infix, .operands = {"a", "b"},
     .typing = Typing::Order, .kernels = {}},
    {.op = Operator::Greater, .name = "greater", .source = ">", .form = Form::Infix, .operands = {"a", "b"},
     .typing = Typing::Order, .kernels = {}},
    {.op = Operator::GreaterEqual, .name = "greater_equal", .source = ">=", .form = Form::Infix,
     .operands = {"a", "b"}, .typing = Typing::Order, .kernels = {}},

    {.op = Operator::And, .name = "and", .source = "^", .form = Form::Infix, .operands = {"a", "b"},
     .typing = Typing::Logic, .kernels = {.of_bools = [](bool a, bool b) { return a && b; }}},
    {.op = Operator::Or, .name = "or", .source = "|", .form = Form::Infix, .operands = {"a", "b"},
     .typing = Typing::Logic, .kernels = {.of_bools = [](bool a, bool b) { return a || b; }}},
    {.op = Operator::Not, .name = "not", .source = "~", .form = Form::Prefix, .operands = {"a"},
     .typing = Typing::Logic, .kernels = {.of_bools = [](bool a, bool) { return !a; }}},
    {.op = Operator::Implies, .name = "implies", .source = "=>", .form = Form::Infix, .operands = {"a", "b"},
     .typing = Typing::Logic, .kernels = {.of_bools = [](bool a, bool b) { return !a || b; }}},
    {.op = Operator::Equivalent, .name = "equivalent", .source = "<=>", .form = Form::Infix,
     .operands = {"a", "b"}, .typing = Typing::Logic,
     .kernels = {.of_bools = [](bool a, bool b) { return a == b; }}},

    {.op = Operator::Abs, .name = "absolute", .source = "abs", .form = Form::Function, .operands = {"x"},
     .typing = Typing::Numbers,
     .kernels = {.of_ints = [](const Ints& x) { return rddl::absolute(x.a); },
                 .of_reals = [](const Reals& x) { return rddl::absolute(x.a); }},
     .range = [](Range a, Range) {
         return std::optional(Range{a.lower >= 0 ? a.lower : std::max(0.0, -a.upper), magnitude(a)});
     }},
    {.op = Operator::Sign, .name = "sign", .source = "sgn", .form = Form::Function, .operands = {"x"},
     .typing = Typing::Sign,
     .kernels = {.of_ints = [](const Ints& x) { return rddl::sign(x.a); },
                 .to_int = [](double a) { return rddl::sign(a); }}},
    {.op = Operator::Round, .name = "round", .source = "round", .form = Form::Function, .operands = {"x"},
     .typing = Typing::Rounding, .kernels = {.to_int = [](double a) { return rddl::round(a); }}},
    {.op = Operator::Floor, .name = "floor", .source = "floor", .form = Form::Function, .operands = {"x"},
     .typing = Typing::Rounding, .kernels = {.to_int = [](double a) { return rddl::floor(a); }}},
    {.op = Operator::Ceil, .name = "ceil", .source = "ceil", .form = Form::Function, .operands = {"x"},
     .typing = Typing::Rounding, .kernels = {.to_int = [](double a) { return rddl::ceil(a); }}},
    {.op = Operator::Minimum, .name = "minimum", .source = "min", .form = Form::Function, .operands = {"x", "y"},
     .typing = Typing::Numbers,
     .kernels = {.of_ints = [](const Ints& x) { return rddl::minimum(x.a, x.b); },
                 .of_reals = [](const Reals& x) { return rddl::minimum(x.a, x.b); }},
     .range = [](Range a, Range b) { return hull({std::min(a.lower, b.lower), std::min(a.upper, b.upper)}); }},
    {.op = Operator::Maximum, .name = "maximum", .source = "max", .form = Form::Function, .operands = {"x", "y"},
     .typing = Typing::Numbers,
     .kernels = {.of_ints = [](const Ints& x) { return rddl::maximum(x.a, x.b); },
                 .of_reals = [](const Reals& x) { return rddl::maximum(x.a, x.b); }},
     .range = [](Range a, Range b) { return hull({std::max(a.lower, b.lower), std::max(a.upper, b.upper)}); }},
    {.op = Operator::FloorModuloReal, .name = "floor_mod_real", .source = "fmod", .form = Form::Function,
     .operands = {"dividend", "divisor"}, .typing = Typing::Reals,
     .kernels = {.of_reals = [](const Reals& x) { return rddl::floor_mod(x.a, x.b); }},
     .range = remainder, .elementary = true, .of_ints = Operator::FloorModulo},
    {.op = Operator::Power, .name = "power", .source = "pow", .form = Form::Function,
     .operands = {"base", "exponent"}, .typing = Typing::Numbers,
     .kernels = {.of_ints = [](const Ints& x) { return rddl::power(x.context, x.place, x.a, x.b); },
                 .of_reals = [](const Reals& x) { return rddl::power(x.a, x.b); }},
     .range = power, .faults = Faults::OnInts, .elementary = true},

    {.op = Operator::Exp, .name = "exp", .source = "exp", .form = Form::Function, .operands = {"x"},
     .typing = Typing::Reals, .kernels = {.of_reals = [](const Reals& x) { return rddl::exp(x.a); }},
     .range = [](Range a, Range) { return std::optional(padded({0, std::exp(a.upper)})); }, .elementary = true},
    {.op = Operator::Ln, .name = "ln", .source = "ln", .form = Form::Function, .operands = {"x"},
     .typing = Typing::Reals, .kernels = {.of_reals = [](const Reals& x) { return rddl::ln(x.a); }},
     .range = [](Range a, Range) {
         return a.lower > 0 ? std::optional(padded({std::log(a.lower), std::log(a.upper)})) : std::nullopt;
     }, .elementary = true},
    {.op = Operator::Sqrt, .name = "sqrt", .source = "sqrt", .form = Form::Function, .operands = {"x"},
     .typing = Typing::Reals, .kernels = {.of_reals = [](const Reals& x) { return rddl::sqrt(x.a); }},
     .range = [](Range a, Range) {
         return a.lower >= 0 ? std::optional(Range{std::sqrt(a.lower), std::sqrt(a.upper)}) : std::nullopt;
     }},
    {.op = Operator::Cos, .name = "cos", .source = "cos", .form = Form::Function, .operands = {"x"},
     .typing = Typing::Reals, .kernels = {.of_reals = [](const Reals& x) { return rddl::cos(x.a); }},
     .range = unit, .elementary = true},
    {.op = Operator::Sin, .name = "sin", .source = "sin", .form = Form::Function, .operands = {"x"},
     .typing = Typing::Reals, .kernels = {.of_reals = [](const Reals& x) { return rddl::sin(x.a); }},
     .range = unit, .elementary = true},
    {.op = Operator::Tan, .name = "tan", .source = "tan", .form = Form::Function, .operands = {"x"},
     .typing = Typing::Reals, .kernels = {.of_reals = [](const Reals& x) { return rddl::tan(x.a); }},
     .range = tangent, .elementary = true},
    {.op = Operator::Acos, .name = "acos", .source = "acos", .form = Form::Function, .operands = {"x"},
     .typing = Typing::Reals, .kernels = {.of_reals = [](const Reals& x) { return rddl::acos(x.a); }},
     .range = angle_of_unit, .elementary = true},
    {.op = Operator::Asin, .name = "asin", .source = "asin", .form = Form::Function, .operands = {"x"},
     .typing = Typing::Reals, .kernels = {.of_reals = [](const Reals& x) { return rddl::asin(x.a); }},
     .range = angle_of_unit, .elementary = true},
    {.op = Operator::Atan, .name = "atan", .source = "atan", .form = Form::Function, .operands = {"x"},
     .typing = Typing::Reals, .kernels = {.of_reals = [](const Reals& x) { return rddl::atan(x.a); }},
     .range = angle, .elementary = true},
    {.op = Operator::Cosh, .name = "cosh", .source = "cosh", .form = Form::Function, .operands = {"x"},
     .typing = Typing::Reals, .kernels = {.of_reals = [](const Reals& x) { return rddl::cosh(x.a); }},
     .range = hyperbolic, .elementary = true},
    {.op = Operator::Sinh, .name = "sinh", .source = "sinh", .form = Form::Function, .operands = {"x"},
     .typing = Typing::Reals, .kernels = {.of_reals = [](const Reals& x) { return rddl::sinh(x.a); }},
     .range = hyperbolic, .elementary = true},
    {.op = Operator::Tanh, .name = "tanh", .source = "tanh", .form = Form::Function, .operands = {"x"},
     .typing = Typing::Reals, .kernels = {.of_reals = [](const Reals& x) { return rddl::tanh(x.a); }},
     .range = unit, .elementary = true},
    {.op = Operator::Log, .name = "log", .source = "log", .form = Form::Function, .operands = {"x", "base"},
     .typing = Typing::Reals, .kernels = {.of_reals = [](const Reals& x) { return rddl::log(x.a, x.b); }},
     .elementary = true},
    {.op = Operator::Hypot, .name = "hypot", .source = "hypot", .form = Form::Function, .operands = {"x", "y"},
     .typing = Typing::Reals, .kernels = {.of_reals = [](const Reals& x) { return rddl::hypot(x.a, x.b); }},
     .range = [](Range a, Range b) { return std::optional(padded({0, magnitude(a) + magnitude(b)})); },
     .elementary = true},
    {.op = Operator::Atan2, .name = "atan2", .source = "atan2", .form = Form::Extension, .operands = {"y", "x"},
     .typing = Typing::Reals, .kernels = {.of_reals = [](const Reals& x) { return rddl::atan2(x.a, x.b); }},
     .range = angle, .elementary = true},
    {.op = Operator::LnGamma, .name = "ln_gamma", .source = "lngamma", .form = Form::Function, .operands = {"x"},
     .typing = Typing::Reals,
     .kernels = {.of_reals = [](const Reals& x) { return rddl::ln_gamma(x.context, x.place, x.a); }},
     .faults = Faults::Always, .elementary = true},
    {.op = Operator::Gamma, .name = "gamma", .source = "gamma", .form = Form::Function, .operands = {"x"},
     .typing = Typing::Reals,
     .kernels = {.of_reals = [](const Reals& x) { return rddl::gamma(x.context, x.place, x.a); }},
     .faults = Faults::Always, .elementary = true},

    {.op = Operator::Defined, .name = "defined", .source = "", .form = Form::Internal, .operands = {"x"},
     .typing = Typing::Reals,
     .kernels = {.of_reals = [](const Reals& x) { return rddl::defined(x.context, x.place, x.a); }},
     .range = [](Range a, Range) { return std::optional(a); }, .faults = Faults::Always},
    {.op = Operator::BitAnd, .name = "bit_and", .source = "", .form = Form::Internal, .operands = {"a", "b"},
     .typing = Typing::Ints, .kernels = {.of_ints = [](const Ints& x) { return rddl::bit_and(x.a, x.b); }}},
    {.op = Operator::BitOr, .name = "bit_or", .source = "", .form = Form::Internal, .operands = {"a", "b"},
     .typing = Typing::Ints, .kernels = {.of_ints = [](const Ints& x) { return rddl::bit_or(x.a, x.b); }}},
    {.op = Operator::BitXor, .name = "bit_xor", .source = "", .form = Form::Internal, .operands = {"a", "b"},
     .typing = Typing::Ints, .kernels = {.of_ints = [](const Ints& x) { return rddl::bit_xor(x.a, x.b); }}},
    {.op = Operator::ShiftRight, .name = "shift_right", .source = "", .form = Form::Internal, .operands = {"a", "b"},
     .typing = Typing::Ints, .kernels = {.of_ints = [](const Ints& x) { return rddl::shift_right(x.a, x.b); }}},
    {.op = Operator::CountOnes, .name = "count_ones", .source = "", .form = Form::Internal, .operands = {"x"},
     .typing = Typing::Ints, .kernels = {.of_ints = [](const Ints& x) { return rddl::count_ones(x.a); }}},
};
// clang-format on

// Checks that every kernel exists that the typing asks for, so that no program misses one when it
// runs.
consteval bool has_kernels(const OperatorRow& row) {
    const OperatorKernels& kernels = row.kernels;
    switch (row.typing) {
        case Typing::Equality:
        case Typing::Logic:
            return kernels.of_bools;
        case Typing::Order:
            return row.op >= Operator::Less && row.op <= Operator::GreaterEqual;
        case Typing::Numbers:
            return kernels.of_ints && kernels.of_reals;
        case Typing::Ints:
            return kernels.of_ints;
        case Typing::Reals:
            return kernels.of_reals;
        case Typing::Rounding:
            return kernels.to_int;
        case Typing::Sign:
            return kernels.of_ints && kernels.to_int;
    }
    return false;
}

// A row is found by the enumerator's number, so the orders have to agree.
consteval bool is_complete() {
    for (std::size_t i = 0; i < std::size(operators); ++i)
        if (operators[i].op != static_cast<Operator>(i) || !has_kernels(operators[i])) return false;
    return true;
}
static_assert(is_complete());
static_assert(std::size(operators) == static_cast<std::size_t>(Operator::CountOnes) + 1);

const OperatorRow& row(Operator op) {
    return operators[static_cast<std::size_t>(op)];
}

bool is_function(const OperatorRow& row) {
    return row.form == Form::Function || row.form == Form::Extension;
}

}  // namespace

std::string_view name_of(Operator op) {
    return row(op).name;
}
std::string_view source_name_of(Operator op) {
    return row(op).source;
}
std::string form_of(Operator function) {
    const auto& [first, last] = row(function).operands;
    return fmt::format("{}[{}{}{}]", row(function).source, first, last.empty() ? "" : ", ", last);
}

std::size_t arity_of(Operator op) {
    return row(op).operands.back().empty() ? 1 : 2;
}
Typing typing_of(Operator op) {
    return row(op).typing;
}
std::optional<Operator> on_ints(Operator op) {
    return row(op).typing == Typing::Numbers ? std::optional(op) : row(op).of_ints;
}
bool is_function(Operator op) {
    return is_function(row(op));
}
bool is_extension(Operator op) {
    return row(op).form == Form::Extension;
}
bool is_elementary(Operator op) {
    return row(op).elementary;
}
bool may_fault(Operator op, bool on_integers) {
    return row(op).faults == Faults::Always || (row(op).faults == Faults::OnInts && on_integers);
}

bool is_comparison(Operator op) {
    return is_order(op) || row(op).typing == Typing::Equality;
}
bool is_order(Operator op) {
    return row(op).typing == Typing::Order;
}
Operator mirrored(Operator op) {
    if (op == Operator::Less) return Operator::Greater;
    if (op == Operator::LessEqual) return Operator::GreaterEqual;
    if (op == Operator::Greater) return Operator::Less;
    if (op == Operator::GreaterEqual) return Operator::LessEqual;
    return op;
}

std::optional<Operator> function_named(std::string_view name) {
    for (const OperatorRow& candidate : operators)
        if (is_function(candidate) && candidate.source == name) return candidate.op;
    return std::nullopt;
}

std::vector<std::string> function_names() {
    std::vector<std::string> names;
    for (const OperatorRow& candidate : operators)
        if (is_function(candidate)) names.emplace_back(candidate.source);
    return names;
}

const OperatorKernels& kernels_of(Operator op) {
    return row(op).kernels;
}

std::optional<Range> range_of(Operator op, std::span<const std::optional<Range>> operands) {
    return apply(row(op).range, operands);
}

}  // namespace rddlc
