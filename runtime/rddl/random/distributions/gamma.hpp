// The gamma family. Laws, checks and sources: docs/distributions.md.
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/random/distributions/continuous.hpp>
#include <rddl/random/distributions/normal_quantile.hpp>
#include <rddl/random/random.hpp>
#include <rddl/values/context.hpp>
#include <rddl/values/ops.hpp>

#include <limits>

namespace rddl {

namespace detail {

// shape >= 1. G. Marsaglia, W. Tsang, "A simple method for generating gamma variables", ACM TOMS
// 26 (2000), 363-372: a cube of a normal, accepted more than 95 times in 100.
inline double standard_gamma_from_one(Draws& draws, double shape) {
    if (shape > std::numeric_limits<double>::max()) return shape;
    const double d = shape - 1.0 / 3.0;
    const double c = 1.0 / sqrt(9.0 * d);
    for (int attempt = 0; attempt < rejection_limit; ++attempt) {
        const double x = normal_quantile(draws.open_uniform());
        const double u = draws.open_uniform();
        const double root = 1.0 + c * x;
        if (root <= 0) continue;
        const double v = root * root * root;
        const double square = x * x;
        if (u < 1.0 - 0.0331 * square * square) return d * v;
        if (ln(u) < 0.5 * square + d * (1.0 - v + ln(v))) return d * v;
    }
    return d;
}

}  // namespace detail

// The logarithm of a gamma draw of scale 1: below shape 1, a draw may be less than any double.
// A draw of shape + 1 times U^(1 / shape) has the given shape (Marsaglia and Tsang, section 6).
inline double ln_standard_gamma(Draws& draws, double shape) {
    if (shape >= 1.0) return ln(detail::standard_gamma_from_one(draws, shape));
    const double boost = ln(draws.open_uniform()) / shape;
    return boost + ln(detail::standard_gamma_from_one(draws, shape + 1.0));
}

inline double standard_gamma(Draws& draws, double shape) {
    if (shape >= 1.0) return detail::standard_gamma_from_one(draws, shape);
    const double boost = exp(ln(draws.open_uniform()) / shape);
    return boost * detail::standard_gamma_from_one(draws, shape + 1.0);
}

// Both gamma draws of a quotient underflow so far below every double that their logarithms are also
// infinite, if both shapes are below 1e-306. But with shapes below 1e-200, one draw is greater than
// the others by a factor beyond all doubles, and which one depends on the ratios of the shapes
// alone: all are multiplied by this.
inline double raised_shapes(double greatest) {
    return greatest < 1e-300 ? 0x1p+200 : 1.0;
}

// Standard t: a normal over the root of a chi-square divided by its degrees of freedom.
inline double standard_student(Draws& draws, double degrees) {
    const double normal = normal_quantile(draws.open_uniform());
    if (degrees > std::numeric_limits<double>::max()) return normal;
    const double shape = 0.5 * degrees;
    const double ln_ratio = ln(shape) - ln_standard_gamma(draws, shape);
    return normal * exp(0.5 * ln_ratio);
}

namespace sample {

// Mean shape * scale.
template <class L>
typename L::Real gamma(Context<L>& context, Place place, typename L::Real shape,
                       typename L::Real scale) {
    const auto valid = detail::require_shape_and_scale(context, place, shape, scale);
    const auto kernel = [](Draws& draws, double k, double s) {
        return s * standard_gamma(draws, k);
    };
    return draw_in_each_lane(context, place, valid, kernel, shape, scale);
}

template <class L>
typename L::Real chi_square(Context<L>& context, Place place, typename L::Real degrees) {
    const auto valid = context.require(degrees > 0.0, FaultKind::DegreesOfFreedom, place, degrees);
    const auto kernel = [](Draws& draws, double df) {
        return 2.0 * standard_gamma(draws, 0.5 * df);
    };
    return draw_in_each_lane(context, place, valid, kernel, degrees);
}

// X / (X + Y) of gamma draws, by logarithms: small shapes make both underflow.
template <class L>
typename L::Real beta(Context<L>& context, Place place, typename L::Real a, typename L::Real b) {
    const auto a_is_valid = context.require(a > 0.0, FaultKind::Shape, place, a);
    const auto b_is_valid = context.require(b > 0.0, FaultKind::Shape, place, b);
    const auto kernel = [](Draws& draws, double shape_x, double shape_y) {
        const double factor = raised_shapes(maximum(shape_x, shape_y));
        const double ln_x = ln_standard_gamma(draws, factor * shape_x);
        const double ln_y = ln_standard_gamma(draws, factor * shape_y);
        return 1.0 / (1.0 + exp(ln_y - ln_x));
    };
    return draw_in_each_lane(context, place, a_is_valid && b_is_valid, kernel, a, b);
}

template <class L>
typename L::Real student(Context<L>& context, Place place, typename L::Real degrees) {
    const auto valid = context.require(degrees > 0.0, FaultKind::DegreesOfFreedom, place, degrees);
    return draw_in_each_lane(context, place, valid, standard_student, degrees);
}

}  // namespace sample

}  // namespace rddl
