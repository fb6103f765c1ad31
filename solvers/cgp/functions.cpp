#include "solvers/cgp/functions.hpp"

#include "support/failure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rddlc::solvers {

namespace {

constexpr FunctionInfo all_functions[] = {
    {Function::Add, "add", "arith", 2},       {Function::Subtract, "sub", "arith", 2},
    {Function::Multiply, "mul", "arith", 2},  {Function::Divide, "div", "arith", 2},
    {Function::Negate, "neg", "arith", 1},    {Function::Absolute, "abs", "arith", 1},
    {Function::Minimum, "min", "arith", 2},   {Function::Maximum, "max", "arith", 2},
    {Function::Square, "square", "arith", 1}, {Function::Root, "sqrt", "arith", 1},
    {Function::Sine, "sin", "trig", 1},       {Function::Cosine, "cos", "trig", 1},
    {Function::Tanh, "tanh", "trig", 1},      {Function::Exponential, "exp", "trig", 1},
    {Function::Greater, "gt", "logic", 2},    {Function::If, "if", "logic", 3},
    {Function::And, "and", "logic", 2},       {Function::Or, "or", "logic", 2},
    {Function::Not, "not", "logic", 1},       {Function::Sign, "sign", "logic", 1},
    {Function::One, "one", "logic", 0},       {Function::Zero, "zero", "logic", 0},
    {Function::Half, "half", "arith", 1},     {Function::Floor, "floor", "round", 1},
    {Function::Ceiling, "ceil", "round", 1},  {Function::Round, "round", "round", 1},
};

double bounded(double x) {
    if (std::isnan(x)) return 0;
    return std::clamp(x, -largest_result, largest_result);
}

// Numbers above 0 are true; true is 1, false 0.
double truth(bool holds) {
    return holds ? 1 : 0;
}

// One loop for each function, so that a program of many lanes does not branch in each.
template <class Compute>
void for_each(int count, double* result, Compute compute) {
    for (int i = 0; i < count; ++i) result[i] = compute(i);
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
                          "groups are arith, trig, logic and round", usage_error);
    }
    return functions;
}

std::vector<Function> default_functions() {
    return functions_named({"arith", "trig", "logic"});
}

void apply(Function function, int count, const double* a, const double* b, const double* c,
           double* result) {
    switch (function) {
        case Function::Add:
            return for_each(count, result, [=](int i) { return bounded(a[i] + b[i]); });
        case Function::Subtract:
            return for_each(count, result, [=](int i) { return bounded(a[i] - b[i]); });
        case Function::Multiply:
            return for_each(count, result, [=](int i) { return bounded(a[i] * b[i]); });
        case Function::Divide:  // by nearly nothing: 1
            return for_each(count, result, [=](int i) {
                return std::abs(b[i]) < 1e-9 ? 1.0 : bounded(a[i] / b[i]);
            });
        case Function::Negate:
            return for_each(count, result, [=](int i) { return -a[i]; });
        case Function::Absolute:
            return for_each(count, result, [=](int i) { return std::abs(a[i]); });
        case Function::Minimum:
            return for_each(count, result, [=](int i) { return std::min(a[i], b[i]); });
        case Function::Maximum:
            return for_each(count, result, [=](int i) { return std::max(a[i], b[i]); });
        case Function::Square:
            return for_each(count, result, [=](int i) { return bounded(a[i] * a[i]); });
        case Function::Root:
            return for_each(count, result, [=](int i) { return std::sqrt(std::abs(a[i])); });
        case Function::Sine:
            return for_each(count, result, [=](int i) { return std::sin(a[i]); });
        case Function::Cosine:
            return for_each(count, result, [=](int i) { return std::cos(a[i]); });
        case Function::Tanh:
            return for_each(count, result, [=](int i) { return std::tanh(a[i]); });
        case Function::Exponential:
            return for_each(count, result, [=](int i) { return bounded(std::exp(a[i])); });
        case Function::Greater:
            return for_each(count, result, [=](int i) { return truth(a[i] > b[i]); });
        case Function::If:
            return for_each(count, result, [=](int i) { return a[i] > 0 ? b[i] : c[i]; });
        case Function::And:
            return for_each(count, result, [=](int i) { return truth(a[i] > 0 && b[i] > 0); });
        case Function::Or:
            return for_each(count, result, [=](int i) { return truth(a[i] > 0 || b[i] > 0); });
        case Function::Not:
            return for_each(count, result, [=](int i) { return truth(!(a[i] > 0)); });
        case Function::Sign:
            return for_each(count, result, [=](int i) {
                return a[i] > 0 ? 1.0 : a[i] < 0 ? -1.0 : 0.0;
            });
        case Function::One:
            return for_each(count, result, [=](int) { return 1.0; });
        case Function::Zero:
            return for_each(count, result, [=](int) { return 0.0; });
        case Function::Half:
            return for_each(count, result, [=](int i) { return a[i] * 0.5; });
        case Function::Floor:
            return for_each(count, result, [=](int i) { return std::floor(a[i]); });
        case Function::Ceiling:
            return for_each(count, result, [=](int i) { return std::ceil(a[i]); });
        case Function::Round:
            return for_each(count, result, [=](int i) { return std::nearbyint(a[i]); });
    }
}

double apply(Function function, double a, double b, double c) {
    double result = 0;
    apply(function, 1, &a, &b, &c, &result);
    return result;
}

}  // namespace rddlc::solvers
