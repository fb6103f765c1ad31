#include "ir/range.hpp"

#include <rddl/random/distributions/probability.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

namespace rddlc::ir {
namespace {

// The smallest range that holds all corners; nothing if one of them is nan.
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
    if (!excludes_zero(b)) return std::nullopt;
    return hull({a.lower / b.lower, a.lower / b.upper, a.upper / b.lower, a.upper / b.upper});
}

bool is_probability(Range range) {
    return rddl::is_probability<rddl::Scalar>(range.lower) &&
           rddl::is_probability<rddl::Scalar>(range.upper);
}
bool is_whole_number(double value) {
    return value == std::floor(value);
}
bool is_positive(Range range) {
    return excludes_zero(range) && range.lower > 0 && std::isfinite(range.upper);
}

double magnitude(Range range) {
    return std::max(std::abs(range.lower), std::abs(range.upper));
}
Range symmetric(double magnitude) {
    return {-magnitude, magnitude};
}

// The range with room for the rounding of functions and long sums.
Range padded(Range range) {
    const double slack = 1e-9 * magnitude(range);
    return {range.lower >= 0 ? std::max(0.0, range.lower - slack) : range.lower - slack,
            range.upper <= 0 ? std::min(0.0, range.upper + slack) : range.upper + slack};
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

// The remainder has the divisor's sign.
std::optional<Range> floor_modulo(Range divisor) {
    if (divisor.lower <= 0 && divisor.upper >= 0) return std::nullopt;
    return Range{std::min(0.0, divisor.lower), std::max(0.0, divisor.upper)};
}

}  // namespace

bool is_finite(const Range& range) {
    return magnitude(range) <= std::numeric_limits<float>::max();
}

bool excludes_zero(const std::optional<Range>& range) {
    constexpr double least = std::numeric_limits<float>::denorm_min();
    return range && (range->lower >= least || range->upper <= -least);
}

Range join(Range a, Range b) {
    return {std::min(a.lower, b.lower), std::max(a.upper, b.upper)};
}

std::optional<Range> range_of(Operator op, std::span<const std::optional<Range>> operands) {
    constexpr double most_tangent = 1e20;  // no double is nearer to a pole
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
        case Operator::Abs:
            return Range{a.lower >= 0 ? a.lower : std::max(0.0, -a.upper), magnitude(a)};
        case Operator::Minimum:
            return hull({std::min(a.lower, b.lower), std::min(a.upper, b.upper)});
        case Operator::Maximum:
            return hull({std::max(a.lower, b.lower), std::max(a.upper, b.upper)});
        case Operator::FloorModuloReal:
            return floor_modulo(b);
        case Operator::Power:
            return power(a, b);
        case Operator::Sqrt:
            if (a.lower < 0) return std::nullopt;
            return Range{std::sqrt(a.lower), std::sqrt(a.upper)};
        case Operator::Exp:
            return padded({0, std::exp(a.upper)});
        case Operator::Ln:
            if (a.lower <= 0) return std::nullopt;
            return padded({std::log(a.lower), std::log(a.upper)});
        case Operator::Cos:
        case Operator::Sin:
        case Operator::Tanh:
            return padded({-1, 1});
        case Operator::Tan:
            return symmetric(most_tangent);
        case Operator::Acos:
        case Operator::Asin:
            if (magnitude(a) > 1) return std::nullopt;
            return symmetric(4);
        case Operator::Atan:
        case Operator::Atan2:
            return symmetric(4);
        case Operator::Cosh:
        case Operator::Sinh:
            return padded(symmetric(std::cosh(magnitude(a))));
        case Operator::Hypot:
            return padded({0, magnitude(a) + magnitude(b)});
        case Operator::Defined:
            return a;
        default:
            return std::nullopt;
    }
}

std::optional<Range> range_of(Distribution distribution,
                              std::span<const std::optional<Range>> parameters) {
    constexpr double longest_tail = 40;  // of an exponential or normal draw, in its scale
    for (const std::optional<Range>& parameter : parameters) {
        if (!parameter || !is_finite(*parameter)) return std::nullopt;
    }
    const Range first = *parameters.front();
    const Range last = *parameters.back();
    switch (distribution) {
        case Distribution::KronDelta:
        case Distribution::DiracDelta:
            return first;
        case Distribution::Uniform:
            return padded(join(first, last));
        case Distribution::Normal:  // the second parameter is the variance
            return symmetric(magnitude(first) + longest_tail * std::sqrt(magnitude(last)));
        case Distribution::Exponential:
            return symmetric(longest_tail * magnitude(last));
        case Distribution::Laplace:
        case Distribution::Gumbel:
            return symmetric(magnitude(first) + longest_tail * magnitude(last));
        case Distribution::Cauchy:  // a tangent
            return symmetric(magnitude(first) + 1e20 * magnitude(last));
        case Distribution::Weibull:
            if (first.lower <= 0) return std::nullopt;
            return symmetric(std::pow(longest_tail, 1 / first.lower) * magnitude(last));
        case Distribution::Pareto:
            if (first.lower <= 0) return std::nullopt;
            return symmetric(std::exp(longest_tail / first.lower) * magnitude(last));
        case Distribution::Gamma:  // a normal draw of the method makes it at most 103 times as
                                   // large
            return symmetric(200 * (magnitude(first) + 1) * magnitude(last));
        case Distribution::ChiSquare:  // Gamma(first / 2, 2)
            return symmetric(200 * (magnitude(first) + 2));
        case Distribution::Beta:
        case Distribution::Kumaraswamy:
            return Range{0, 1};
        case Distribution::Gompertz:
            if (first.lower <= 0 || last.lower <= 0) return std::nullopt;
            return symmetric((longest_tail / first.lower + 1) * (longest_tail / last.lower + 1));
        case Distribution::Student:  // a quotient by what may be next to 0
        case Distribution::Bernoulli:
        case Distribution::Poisson:
        case Distribution::Binomial:
        case Distribution::NegativeBinomial:
        case Distribution::Geometric:
            return std::nullopt;  // the last five are not real
    }
    return std::nullopt;
}

Range range_of_sum(const Range& term, double count) {
    const auto total = [&](double bound) {
        return bound == 0 ? 0.0 : bound * count;
    };
    return padded({std::min(0.0, total(term.lower)), std::max(0.0, total(term.upper))});
}

Range range_of_product(const Range& factor, double count) {
    const double most = std::pow(std::max(1.0, magnitude(factor)), count);
    return padded(factor.lower >= 0 ? Range{0, most} : symmetric(most));
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
