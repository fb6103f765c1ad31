#include "autodiff/partials.hpp"

#include "support/sigmoid.hpp"

#include <cmath>
#include <limits>

namespace rddlc::autodiff {
namespace {

// The derivative of ln(gamma(x)): recurrence, then the asymptotic series. Elsewhere than for x > 0
// gamma faults, and the recurrence might take for ever.
double digamma(double x) {
    if (!(x > 0)) return std::numeric_limits<double>::quiet_NaN();
    double shift = 0;
    for (; x < 10; x += 1) shift -= 1 / x;
    const double y = 1 / (x * x);
    return shift + std::log(x) - 0.5 / x -
           y * (1.0 / 12 - y * (1.0 / 120 - y * (1.0 / 252 - y * (1.0 / 240 - y / 132))));
}

double sign(double x) {
    return x > 0 ? 1 : x < 0 ? -1 : 0;
}

Partials of_power(double base, double exponent, double value) {
    const double by_base = exponent == 0 ? 0 : exponent * std::pow(base, exponent - 1);
    return {by_base, base > 0 ? std::log(base) * value : 0};
}

}  // namespace

// Over 40 lines: a table of all operators, of which the compiler sees that none is missing.
Partials of_operator(Operator op, double a, double b, double v) {
    switch (op) {
        case Operator::Add:
            return {1, 1};
        case Operator::Subtract:
            return {1, -1};
        case Operator::Multiply:
            return {b, a};
        case Operator::Negate:
            return {-1};
        case Operator::Divide:
            return {1 / b, -v / b};
        case Operator::Abs:
            return {sign(a)};
        case Operator::Minimum:
            return b < a ? Partials{0, 1} : Partials{1, 0};
        case Operator::Maximum:
            return b > a ? Partials{0, 1} : Partials{1, 0};
        case Operator::FloorModuloReal:
            return {1, -std::floor(a / b)};
        case Operator::Power:
            return of_power(a, b, v);
        case Operator::Exp:
            return {v};
        case Operator::Ln:
            return {1 / a};
        case Operator::Sqrt:
            return {0.5 / v};
        case Operator::Cos:
            return {-std::sin(a)};
        case Operator::Sin:
            return {std::cos(a)};
        case Operator::Tan:
            return {1 + v * v};
        case Operator::Acos:
            return {-1 / std::sqrt((1 - a) * (1 + a))};
        case Operator::Asin:
            return {1 / std::sqrt((1 - a) * (1 + a))};
        case Operator::Atan:
            return {1 / (1 + a * a)};
        case Operator::Cosh:
            return {std::sinh(a)};
        case Operator::Sinh:
            return {std::cosh(a)};
        case Operator::Tanh:
            return {(1 - v) * (1 + v)};
        case Operator::Log:
            return {1 / (a * std::log(b)), -v / (b * std::log(b))};
        case Operator::Hypot:
            return {a / v, b / v};
        case Operator::Atan2: {
            const double square = a * a + b * b;
            return {b / square, -a / square};
        }
        case Operator::LnGamma:
            return {digamma(a)};
        case Operator::Gamma:
            return {v * digamma(a)};
        case Operator::Defined:
            return {1};
        // Their values are bools or ints.
        case Operator::FloorDivide:
        case Operator::FloorModulo:
        case Operator::Equal:
        case Operator::NotEqual:
        case Operator::Less:
        case Operator::LessEqual:
        case Operator::Greater:
        case Operator::GreaterEqual:
        case Operator::And:
        case Operator::Or:
        case Operator::Not:
        case Operator::Implies:
        case Operator::Equivalent:
        case Operator::Sign:
        case Operator::Round:
        case Operator::Floor:
        case Operator::Ceil:
        case Operator::BitAnd:
        case Operator::BitOr:
        case Operator::BitXor:
        case Operator::ShiftRight:
        case Operator::CountOnes:
            break;
    }
    return {};
}

Partials of_int_operator(Operator op, double a, double b, double v, bool is_relaxed) {
    if (is_one_of(op, {Operator::FloorDivide, Operator::FloorModulo}) && is_relaxed && b != 0)
        return op == Operator::FloorDivide ? Partials{1 / b, -a / (b * b)}
                                           : Partials{1, -std::floor(a / b)};
    if (op == Operator::Power && !is_relaxed) return {};
    return of_operator(op, a, b, v);
}

Partials of_logic(Operator op, double a, double b) {
    if (op == Operator::And) return {b, a};
    if (op == Operator::Or) return {1 - b, 1 - a};
    if (op == Operator::Not) return {-1};
    if (op == Operator::Implies) return {b - 1, a};
    if (op == Operator::NotEqual) return {1 - 2 * b, 1 - 2 * a};
    return {2 * b - 1, 2 * a - 1};  // Equivalent, Equal
}

Partials of_comparison(Operator op, double a, double b, double sharpness) {
    const double z = sharpness * (a - b);
    double slope;
    if (is_one_of(op, {Operator::Equal, Operator::NotEqual})) {
        const double t = std::tanh(z);
        slope = (op == Operator::Equal ? -2 : 2) * t * (1 - t * t);
    } else {
        const double s = sigmoid(z);
        slope = s * (1 - s) * (is_one_of(op, {Operator::Less, Operator::LessEqual}) ? -1 : 1);
    }
    return {sharpness * slope, -sharpness * slope};
}

Partials of_rounding(Operator op, double a, double sharpness) {
    if (op != Operator::Sign) return {1};
    const double t = std::tanh(sharpness * a);
    return {sharpness * (1 - t * t)};
}

Partials of_real_draw(Distribution distribution, double a, double b, double v) {
    switch (distribution) {
        case Distribution::Uniform: {
            const double u = b > a ? (v - a) / (b - a) : 0.5;
            return {1 - u, u};
        }
        case Distribution::Normal:
            return {1, b > 0 ? (v - a) / (2 * b) : 0};
        case Distribution::Exponential:
            return {v / a};
        case Distribution::Weibull:
            return {-v * std::log(v / b) / a, v / b};
        case Distribution::Gamma:
            return {0, v / b};
        case Distribution::Pareto:  // Lomax's form
            return {-(v + b) * std::log1p(v / b) / a, v / b};
        case Distribution::Gumbel:
        case Distribution::Laplace:
        case Distribution::Cauchy:
            return {1, (v - a) / b};
        case Distribution::Gompertz: {
            // v = ln(1 + e / a) / b, with e of the standard exponential distribution.
            const double growth = std::exp(-b * v);
            return {-(1 - growth) / (a * b), -v / b};
        }
        case Distribution::Kumaraswamy: {
            // v^a = 1 - u^(1/b)
            const double power = std::pow(v, a);
            const double by_power = v / (a * power);
            return {-v * std::log(v) / a, by_power * (1 - power) * std::log1p(-power) / b};
        }
        case Distribution::Beta:
        case Distribution::Student:
        case Distribution::ChiSquare:
        case Distribution::KronDelta:
        case Distribution::DiracDelta:
        case Distribution::Bernoulli:
        case Distribution::Poisson:
        case Distribution::Binomial:
        case Distribution::NegativeBinomial:
        case Distribution::Geometric:
            break;
    }
    return {};
}

Partials of_int_draw(Distribution distribution, double a, double b) {
    if (distribution == Distribution::Poisson) return {1};
    if (distribution == Distribution::Geometric) return {-1 / (a * a)};
    if (distribution == Distribution::NegativeBinomial) return {(1 - b) / b, -a / (b * b)};
    return {};
}

}  // namespace rddlc::autodiff
