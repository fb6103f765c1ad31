// Continuous distributions by inversion: one uniform number each, so a draw is a monotone
// function of it. U is uniform on the open interval (0, 1) and stands for 1 - U where that is the
// same law. Laws, checks and sources: docs/distributions.md.
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/random/distributions/normal_quantile.hpp>
#include <rddl/random/random.hpp>
#include <rddl/values/context.hpp>
#include <rddl/values/ops.hpp>

#include <cstdint>
#include <limits>
#include <numbers>
#include <type_traits>

namespace rddl {

struct StandardNormal {
    static constexpr std::uint32_t kind = 1;
    template <class Real>
    static Real of(const Real& number) {
        return normal_quantile(open_unit_real(number));
    }
    // Several uniform numbers become normals, `most` at most.
    template <std::uint32_t most, class R, int n>
    static void replace(Lanes<R, n>* numbers, std::uint32_t count) {
        for (std::uint32_t i = 0; i < count; ++i) numbers[i] = open_unit_real(numbers[i]);
        if (count == 1)
            numbers[0] = normal_quantile(numbers[0]);
        else
            replace_by_normal_quantiles<most>(numbers, count);
    }
};

// -ln U.
struct StandardExponential {
    static constexpr std::uint32_t kind = 2;
    template <RealLanes Real>
    static RDDL_INLINE Real of(const Real& number) {
        return -detail::ln_of_positive(open_unit_real(number), Real{0.0});
    }
    template <FloatLanes Real>
    static Real of(const Real& number) {
        return -ln(open_unit_real(number));
    }
};

}  // namespace rddl

namespace rddl::sample {

// A uniform draw from [lower, upper); lower = upper gives lower. The width must be finite and not
// negative.
template <class L, class SomePlace = Place>
RDDL_INLINE typename L::Real uniform(Context<L>& context, SomePlace place, typename L::Real lower,
                                     typename L::Real upper) {
    using Real = typename L::Real;
    const Real width = upper - lower;
    const auto valid =
        context.require(width >= 0.0 && width <= std::numeric_limits<typename L::Element>::max(),
                        FaultKind::Width, place, width);
    const Real draw = lower + width * uniform_at(context, place);
    const Real rounded_into_range = select(draw < upper, draw, lower);
    return select(valid, rounded_into_range, Real{0});
}

namespace detail {

// A parameter that is one number stays one, so that compilers know what is made of constants.
template <class L, class Parameter>
RDDL_INLINE auto parameter(const Parameter& value) {
    if constexpr (std::is_arithmetic_v<Parameter>)
        return static_cast<typename L::Element>(value);
    else
        return typename L::Real(value);
}

}  // namespace detail

// Variance, not standard deviation; variance 0 gives the mean. Each is a real of L, or one number.
template <class L, class Mean, class Variance, class SomePlace = Place>
RDDL_INLINE typename L::Real normal(Context<L>& context, SomePlace place, const Mean& mean,
                                    const Variance& variance) {
    using Real = typename L::Real;
    const auto squared_scale = detail::parameter<L>(variance);
    const typename L::Bool not_negative(squared_scale >= typename L::Element{0});
    const auto valid = context.require(not_negative, FaultKind::Variance, place, squared_scale);
    const Real standard = standard_at<StandardNormal>(context, place);
    const Real draw = detail::parameter<L>(mean) + sqrt(squared_scale) * standard;
    return select(valid, draw, Real{0});
}

// -mean ln U.
template <class L, class SomePlace = Place>
RDDL_INLINE typename L::Real exponential(Context<L>& context, SomePlace place,
                                         typename L::Real mean) {
    using Real = typename L::Real;
    const auto valid = context.require(mean > 0.0, FaultKind::Mean, place, mean);
    return select(valid, standard_at<StandardExponential>(context, place) * mean, Real{0});
}

namespace detail {

template <class L>
RDDL_INLINE auto require_shape_and_scale(Context<L>& context, Place place, typename L::Real shape,
                                         typename L::Real scale) {
    const auto shape_is_valid = context.require(shape > 0.0, FaultKind::Shape, place, shape);
    const auto scale_is_valid = context.require(scale > 0.0, FaultKind::Scale, place, scale);
    return shape_is_valid && scale_is_valid;
}

}  // namespace detail

// scale (-ln U)^(1 / shape).
template <class L, class SomePlace = Place>
RDDL_INLINE typename L::Real weibull(Context<L>& context, SomePlace place, typename L::Real shape,
                                     typename L::Real scale) {
    using Real = typename L::Real;
    const auto valid = detail::require_shape_and_scale(context, place, shape, scale);
    const Real standard = standard_at<StandardExponential>(context, place);
    return select(valid, scale * power(standard, Real{1} / shape), Real{0});
}

// Lomax's form, with support from 0: scale (U^(-1 / shape) - 1).
template <class L, class SomePlace = Place>
typename L::Real pareto(Context<L>& context, SomePlace place, typename L::Real shape,
                        typename L::Real scale) {
    using Real = typename L::Real;
    const auto valid = detail::require_shape_and_scale(context, place, shape, scale);
    const Real logarithm = standard_at<StandardExponential>(context, place) / shape;
    return select(valid, scale * exp_minus_one(logarithm), Real{0});
}

// location - scale ln(-ln U): of maxima.
template <class L, class SomePlace = Place>
typename L::Real gumbel(Context<L>& context, SomePlace place, typename L::Real location,
                        typename L::Real scale) {
    using Real = typename L::Real;
    const auto valid = context.require(scale > 0.0, FaultKind::Scale, place, scale);
    const Real standard = -ln(standard_at<StandardExponential>(context, place));
    return select(valid, location + scale * standard, Real{0});
}

// An exponential on either side of the location.
template <class L, class SomePlace = Place>
typename L::Real laplace(Context<L>& context, SomePlace place, typename L::Real location,
                         typename L::Real scale) {
    using Real = typename L::Real;
    const auto valid = context.require(scale > 0.0, FaultKind::Scale, place, scale);
    const Real u = open_uniform_at(context, place);
    const Real tail = ln(Real{2} * minimum(u, Real{1} - u));
    return select(valid, location + scale * select(u < 0.5, tail, -tail), Real{0});
}

// tan(pi (U - 1/2)) as a cotangent of the distance to the nearer end: exact in both tails.
template <class L, class SomePlace = Place>
typename L::Real cauchy(Context<L>& context, SomePlace place, typename L::Real location,
                        typename L::Real scale) {
    using Real = typename L::Real;
    const auto valid = context.require(scale > 0.0, FaultKind::Scale, place, scale);
    const Real u = open_uniform_at(context, place);
    const Real tail =
        Real{1} / tan(std::numbers::pi_v<typename L::Element> * minimum(u, Real{1} - u));
    return select(valid, location + scale * select(u < 0.5, -tail, tail), Real{0});
}

// ln(1 - ln(U) / shape) / rate; RDDL calls the rate a scale.
template <class L, class SomePlace = Place>
typename L::Real gompertz(Context<L>& context, SomePlace place, typename L::Real shape,
                          typename L::Real rate) {
    using Real = typename L::Real;
    const auto valid = detail::require_shape_and_scale(context, place, shape, rate);
    const Real standard = standard_at<StandardExponential>(context, place);
    return select(valid, ln_one_plus(standard / shape) / rate, Real{0});
}

// (1 - U^(1/b))^(1/a).
template <class L, class SomePlace = Place>
typename L::Real kumaraswamy(Context<L>& context, SomePlace place, typename L::Real a,
                             typename L::Real b) {
    using Real = typename L::Real;
    const auto a_is_valid = context.require(a > 0.0, FaultKind::Shape, place, a);
    const auto b_is_valid = context.require(b > 0.0, FaultKind::Shape, place, b);
    const Real inner = -exp_minus_one(ln(open_uniform_at(context, place)) / b);
    return select(a_is_valid && b_is_valid, power(inner, Real{1} / a), Real{0});
}

}  // namespace rddl::sample
