#include "ir/range.hpp"

#include <rddl/distributions/probability.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace rddlc::ir {
namespace {

// The smallest range that holds all corners; none if one of them is nan.
std::optional<Range> hull(std::initializer_list<double> corners) {
    for (double corner : corners) {
        if (std::isnan(corner)) return std::nullopt;
    }
    return Range{std::min(corners), std::max(corners)};
}

std::optional<Range> multiply(Range a, Range b) {
    return hull({a.lower * b.lower, a.lower * b.upper, a.upper * b.lower, a.upper * b.upper});
}

// A zero in the divisor makes nan possible.
std::optional<Range> divide(Range a, Range b) {
    if (b.lower <= 0 && b.upper >= 0) return std::nullopt;
    return hull({a.lower / b.lower, a.lower / b.upper, a.upper / b.lower, a.upper / b.upper});
}

bool is_finite(Range range) {
    return std::isfinite(range.lower) && std::isfinite(range.upper);
}
bool is_probability(Range range) {
    return rddl::is_probability<rddl::Scalar>(range.lower) &&
           rddl::is_probability<rddl::Scalar>(range.upper);
}
bool is_at_least(const std::optional<Range>& range, double least) {
    return range && range->lower >= least;
}
bool is_whole_number(double value) {
    return value == std::floor(value);
}
bool is_positive(Range range) {
    return range.lower > 0 && std::isfinite(range.upper);
}

}  // namespace

Range join(Range a, Range b) {
    return {std::min(a.lower, b.lower), std::max(a.upper, b.upper)};
}

std::optional<Range> range_of(Operator op, std::span<const std::optional<Range>> operands) {
    for (const std::optional<Range>& operand : operands) {
        if (!operand || !is_finite(*operand)) return std::nullopt;
    }
    const Range a = *operands.front();
    const Range b = *operands.back();
    switch (op) {
        case Operator::Add:
            return hull({a.lower + b.lower, a.upper + b.upper});
        case Operator::Subtract:
            return hull({a.lower - b.upper, a.upper - b.lower});
        case Operator::Multiply:
            return multiply(a, b);
        case Operator::Divide:
            return divide(a, b);
        case Operator::Negate:
            return Range{-a.upper, -a.lower};
        case Operator::Minimum:
            return hull({std::min(a.lower, b.lower), std::min(a.upper, b.upper)});
        case Operator::Maximum:
            return hull({std::max(a.lower, b.lower), std::max(a.upper, b.upper)});
        default:
            return std::nullopt;
    }
}

bool keeps_finite(Operator op, std::span<const std::optional<Range>> operands) {
    constexpr double least_divisor = 1e-30, most_factors = 16;
    const std::optional<Range>& first = operands.front();
    const std::optional<Range>& last = operands.back();
    switch (op) {
        case Operator::Divide:
            return last && (last->lower >= least_divisor || last->upper <= -least_divisor);
        case Operator::Power: {
            if (!last || last->lower < 0 || last->upper > most_factors) return false;
            const bool is_whole = last->lower == last->upper && is_whole_number(last->lower);
            return is_whole || is_at_least(first, 0);
        }
        case Operator::Sqrt:
            return is_at_least(first, 0);
        case Operator::FloorModuloReal:
        case Operator::Exp:
        case Operator::Ln:
        case Operator::Acos:
        case Operator::Asin:
        case Operator::Cosh:
        case Operator::Sinh:
        case Operator::Log:
        case Operator::LnGamma:
        case Operator::Gamma:
            return false;
        default:
            return true;
    }
}

// By the uniform number that is nearest to 0, which is 2^-53, or 2^-24 of floats; -ln of it is 37.
bool draws_finite(Distribution distribution, std::span<const std::optional<Range>> parameters) {
    const std::optional<Range>& first = parameters.front();
    const std::optional<Range>& last = parameters.back();
    switch (distribution) {
        case Distribution::Weibull:
            return is_at_least(first, 0.1);  // 37^10
        case Distribution::Pareto:
            return is_at_least(first, 1);  // e^37
        case Distribution::Student:
            return is_at_least(first, 1);  // a normal by the root of a chi-square by its degrees
        case Distribution::Gompertz:
            return is_at_least(first, 1e-30) && is_at_least(last, 1e-30);  // a quotient by each
        default:
            return true;
    }
}

bool always_in_domain(Distribution distribution, std::span<const std::optional<Range>> parameters) {
    for (const std::optional<Range>& parameter : parameters) {
        if (!parameter || !is_finite(*parameter)) return false;
    }
    const Range first = *parameters.front();
    const Range last = *parameters.back();
    switch (distribution) {
        case Distribution::KronDelta:
        case Distribution::DiracDelta:
            return true;
        case Distribution::Bernoulli:
            return is_probability(first);
        case Distribution::Uniform:
            return first.upper <= last.lower && std::isfinite(last.upper - first.lower);
        case Distribution::Normal:
            return last.lower >= 0;
        case Distribution::Gumbel:
        case Distribution::Laplace:
        case Distribution::Cauchy:
            return is_positive(last);
        case Distribution::Exponential:
        case Distribution::Weibull:
        case Distribution::Gamma:
        case Distribution::Beta:
        case Distribution::Pareto:
        case Distribution::Student:
        case Distribution::Gompertz:
        case Distribution::ChiSquare:
        case Distribution::Kumaraswamy:
            return is_positive(first) && is_positive(last);
        case Distribution::Geometric:
            return is_probability(first) && first.lower > 0;
        case Distribution::Poisson:
        case Distribution::Binomial:
        case Distribution::NegativeBinomial:
            return false;  // their limits on large counts belong to the runtime
    }
    return false;
}

}  // namespace rddlc::ir
