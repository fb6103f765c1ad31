// The functions of a program's nodes. All are total: no result is nan, or beyond +-1e6.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::solvers {

enum class Function : std::uint8_t {
    Add,
    Subtract,
    Multiply,
    Divide,
    Negate,
    Absolute,
    Minimum,
    Maximum,
    Square,
    Root,
    Sine,
    Cosine,
    Tanh,
    Exponential,
    Greater,
    If,
    And,
    Or,
    Not,
    Sign,
    One,
    Zero,
    Half,
    Floor,
    Ceiling,
    Round,
    // The functions of scikit-decide, from [-1, 1] to [-1, 1].
    HalfSum,
    HalfDistance,
    ScaledExponential,  // (e^a - 1) / (e - 1)
    ScaledLength,       // of (a, b), by that of (1, 1)
    AbsolutePower,      // |a|^|b|
    ArcSine,            // by pi / 2
    ArcCosine,          // by pi
    ArcTangent          // by pi / 4
};
inline constexpr int function_count = static_cast<int>(Function::ArcTangent) + 1;
inline constexpr double largest_result = 1e6;

struct FunctionInfo {
    Function function;
    const char* name;   // in files and options
    const char* group;  // arith, trig, logic, round, unit
    int arity;          // 0 .. 3
};
const FunctionInfo& info_of(Function function);
std::optional<Function> function_named(std::string_view name);

// Names of functions and groups: "arith,logic,sin". Throws an OptionRefused at a word that is
// neither.
std::vector<Function> functions_named(const std::vector<std::string>& words);
// arith, trig and logic.
std::vector<Function> default_functions();

// Ignores arguments beyond the arity.
double apply(Function function, double a, double b, double c);
// The same of rows of `count` numbers.
void apply(Function function, int count, const double* a, const double* b, const double* c,
           double* result);

}  // namespace rddlc::solvers
