#include "ir/rounding.hpp"

#include <algorithm>
#include <cmath>

namespace rddlc::ir {
namespace {

// Some units in the last place. pyRDDLGym's gamma function is a series that ends early.
constexpr double usual = 1e-14, of_gamma = 1e-11;

bool is_library_function(Operator op) {
    return op == Operator::FloorModuloReal || op == Operator::Power ||
           (op >= Operator::Exp && op <= Operator::Gamma && op != Operator::Sqrt);
}

}  // namespace

double Rounding::error(double size, double relative) {
    return std::isfinite(size) ? size * std::uniform_real_distribution(-relative, relative)(random_)
                               : 0;
}

// Whole numbers, such as cos(0) and pow(2, 3), are exact in all libraries.
double Rounding::of_function(Operator op, double result) {
    if (op == Operator::LnGamma || op == Operator::Gamma)
        return result + error(std::max(1.0, std::abs(result)), of_gamma);
    if (!is_library_function(op) || result == std::nearbyint(result)) return result;
    return result + error(result, usual);
}

// Knuth's two-sum gives the lost part.
double Rounding::sum(double a, double b) {
    const double sum = a + b, second = sum - a;
    const double lost = (a - (sum - second)) + (b - second);
    if (lost == 0) return sum;
    return sum + error(std::max({std::abs(a), std::abs(b), std::abs(sum)}), usual);
}

double Rounding::product(double a, double b) {
    const double product = a * b;
    return std::fma(a, b, -product) == 0 ? product : product + error(product, usual);
}

}  // namespace rddlc::ir
