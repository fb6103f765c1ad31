#include "solvers/cgp/functions.hpp"

#include "support/failure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

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

double bounded(double x) {
    if (std::isnan(x)) return 0;
    return std::clamp(x, -largest_result, largest_result);
}

// Numbers above 0 are true; true is 1, false 0.
double truth(bool holds) {
    return holds ? 1 : 0;
}

// Calls use(compute), where compute(a, b, c) is the function.
template <class Use>
void with(Function function, Use use) {
    switch (function) {
        case Function::Add:
            return use([](double a, double b, double) { return bounded(a + b); });
        case Function::Subtract:
            return use([](double a, double b, double) { return bounded(a - b); });
        case Function::Multiply:
            return use([](double a, double b, double) { return bounded(a * b); });
        case Function::Divide:  // by nearly nothing: 1
            return use([](double a, double b, double) {
                return std::abs(b) < 1e-9 ? 1.0 : bounded(a / b);
            });
        case Function::Negate:
            return use([](double a, double, double) { return -a; });
        case Function::Absolute:
            return use([](double a, double, double) { return std::abs(a); });
        case Function::Minimum:
            return use([](double a, double b, double) { return std::min(a, b); });
        case Function::Maximum:
            return use([](double a, double b, double) { return std::max(a, b); });
        case Function::Square:
            return use([](double a, double, double) { return bounded(a * a); });
        case Function::Root:
            return use([](double a, double, double) { return std::sqrt(std::abs(a)); });
        case Function::Sine:
            return use([](double a, double, double) { return std::sin(a); });
        case Function::Cosine:
            return use([](double a, double, double) { return std::cos(a); });
        case Function::Tanh:
            return use([](double a, double, double) { return std::tanh(a); });
        case Function::Exponential:
            return use([](double a, double, double) { return bounded(std::exp(a)); });
        case Function::Greater:
            return use([](double a, double b, double) { return truth(a > b); });
        case Function::If:
            return use([](double a, double b, double c) { return a > 0 ? b : c; });
        case Function::And:
            return use([](double a, double b, double) { return truth(a > 0 && b > 0); });
        case Function::Or:
            return use([](double a, double b, double) { return truth(a > 0 || b > 0); });
        case Function::Not:
            return use([](double a, double, double) { return truth(!(a > 0)); });
        case Function::Sign:
            return use([](double a, double, double) { return a > 0 ? 1.0 : a < 0 ? -1.0 : 0.0; });
        case Function::One:
            return use([](double, double, double) { return 1.0; });
        case Function::Zero:
            return use([](double, double, double) { return 0.0; });
        case Function::Half:
            return use([](double a, double, double) { return a * 0.5; });
        case Function::Floor:
            return use([](double a, double, double) { return std::floor(a); });
        case Function::Ceiling:
            return use([](double a, double, double) { return std::ceil(a); });
        case Function::Round:
            return use([](double a, double, double) { return std::nearbyint(a); });
        case Function::HalfSum:
            return use([](double a, double b, double) { return bounded(0.5 * (a + b)); });
        case Function::HalfDistance:
            return use([](double a, double b, double) { return bounded(0.5 * std::abs(a - b)); });
        case Function::ScaledExponential:
            return use([](double a, double, double) {
                return bounded((std::exp(a) - 1) / (std::exp(1.0) - 1));
            });
        case Function::ScaledLength:
            return use([](double a, double b, double) {
                return bounded(std::sqrt(a * a + b * b) / std::sqrt(2.0));
            });
        case Function::AbsolutePower:
            return use([](double a, double b, double) {
                return bounded(std::pow(std::abs(a), std::abs(b)));
            });
        case Function::ArcSine:
            return use([](double a, double, double) {
                return 2 * std::asin(std::clamp(a, -1.0, 1.0)) / std::numbers::pi;
            });
        case Function::ArcCosine:
            return use([](double a, double, double) {
                return std::acos(std::clamp(a, -1.0, 1.0)) / std::numbers::pi;
            });
        case Function::ArcTangent:
            return use(
                [](double a, double, double) { return 4 * std::atan(a) / std::numbers::pi; });
    }
}

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
            throw Failure(fmt::format("'{}' is no function of CGP, nor a group of them", word),
                          "groups are arith, trig, logic, round and unit", usage_error);
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
