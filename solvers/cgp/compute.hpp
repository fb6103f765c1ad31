// The functions of programs, for loops that know which function it is before they begin.
#pragma once

#include "solvers/cgp/functions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rddlc::solvers {

inline double bounded(double x) {
    if (std::isnan(x)) return 0;
    return std::clamp(x, -largest_result, largest_result);
}

// Numbers above 0 are true; true is 1, false 0.
inline double truth(bool holds) {
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

}  // namespace rddlc::solvers
