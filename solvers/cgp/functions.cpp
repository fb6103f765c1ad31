#include "solvers/cgp/functions.hpp"

#include "solvers/cgp/compute.hpp"
#include "solvers/options/options.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rddlc::solvers {

namespace {

constexpr FunctionInfo all_functions[] = {
    {Function::Add, "add", "arith", 2},
    {Function::Subtract, "sub", "arith", 2},
    {Function::Multiply, "mul", "arith", 2},
    {Function::Divide, "div", "arith", 2},
    {Function::Negate, "neg", "arith", 1},
    {Function::Absolute, "abs", "arith", 1},
    {Function::Minimum, "min", "arith", 2},
    {Function::Maximum, "max", "arith", 2},
    {Function::Square, "square", "arith", 1},
    {Function::Root, "sqrt", "arith", 1},
    {Function::Sine, "sin", "trig", 1},
    {Function::Cosine, "cos", "trig", 1},
    {Function::Tanh, "tanh", "trig", 1},
    {Function::Exponential, "exp", "trig", 1},
    {Function::Greater, "gt", "logic", 2},
    {Function::If, "if", "logic", 3},
    {Function::And, "and", "logic", 2},
    {Function::Or, "or", "logic", 2},
    {Function::Not, "not", "logic", 1},
    {Function::Sign, "sign", "logic", 1},
    {Function::One, "one", "logic", 0},
    {Function::Zero, "zero", "logic", 0},
    {Function::Half, "half", "arith", 1},
    {Function::Floor, "floor", "round", 1},
    {Function::Ceiling, "ceil", "round", 1},
    {Function::Round, "round", "round", 1},
    {Function::HalfSum, "halfsum", "unit", 2},
    {Function::HalfDistance, "halfdist", "unit", 2},
    {Function::ScaledExponential, "uexp", "unit", 1},
    {Function::ScaledLength, "ulength", "unit", 2},
    {Function::AbsolutePower, "upow", "unit", 2},
    {Function::ArcSine, "uasin", "unit", 1},
    {Function::ArcCosine, "uacos", "unit", 1},
    {Function::ArcTangent, "uatan", "unit", 1},
};

}  // namespace

const FunctionInfo& info_of(Function function) {
    return all_functions[static_cast<std::size_t>(function)];
}

std::optional<Function> function_named(std::string_view name) {
    for (const FunctionInfo& info : all_functions)
        if (name == info.name) return info.function;
    return std::nullopt;
}

std::vector<Function> functions_named(const std::vector<std::string>& words) {
    std::vector<Function> functions;
    const auto add = [&](Function function) {
        if (std::find(functions.begin(), functions.end(), function) == functions.end())
            functions.push_back(function);
    };
    for (const std::string& word : words) {
        const std::size_t before = functions.size();
        for (const FunctionInfo& info : all_functions)
            if (word == info.name || word == info.group) add(info.function);
        if (functions.size() == before && !function_named(word))
            throw OptionRefused(
                fmt::format("'{}' is not a CGP function or a group of functions: groups are arith, "
                            "trig, logic, round and unit",
                            word));
    }
    return functions;
}

std::vector<Function> default_functions() {
    return functions_named({"arith", "trig", "logic"});
}

// One loop for each function, so that a program of many lanes does not branch in each.
void apply(Function function, int count, const double* a, const double* b, const double* c,
           double* result) {
    with(function, [&](auto compute) {
        for (int i = 0; i < count; ++i) result[i] = compute(a[i], b[i], c[i]);
    });
}

double apply(Function function, double a, double b, double c) {
    double result = 0;
    with(function, [&](auto compute) { result = compute(a, b, c); });
    return result;
}

}  // namespace rddlc::solvers
