// exp and exp - 1.
#pragma once

#include <rddl/lanes/real.hpp>
#include <rddl/values/math/parts.hpp>

namespace rddl {

namespace detail {

inline constexpr double one_over_ln_2 = 0x1.71547652b82fep0;
// Their sum is ln 2. The first has 42 bits, so that its products with exponents are exact.
inline constexpr double ln_2_high = 0x1.62e42fefa38p-1;
inline constexpr double ln_2_low = 0x1.ef35793c7673p-45;

// e^r = 1 + r + r^2 p(r) for |r| <= ln(2) / 2, up to 2^-63 of it.
// From docs/mathematics/coefficients.py.
inline constexpr double exp_coefficients[] = {
    0.5,
    0.16666666666666685,
    0.041666666666666526,
    0.008333333333315995,
    0.0013888888888968006,
    0.00019841269898513518,
    2.4801587155248963e-05,
    2.7557233039832656e-06,
    2.755741770284334e-07,
    2.511259393317407e-08,
    2.0871063566459838e-09,
};

// The number 2^exponent (1 + linear + rest): |linear| <= 0.347 without rounding, |rest| < 0.08.
template <class R>
struct Exponential {
    R exponent;
    R linear;
    R rest;
};

// e^(high + low), for |high| <= 750 and |low| < 2^-43.
template <class R>
RDDL_ALWAYS_INLINE Exponential<R> exponential(R high, R low) {
    const R exponent = nearest_integer(high * one_over_ln_2);
    const R linear = high - exponent * ln_2_high;
    const R correction = low - exponent * ln_2_low;
    const R r = linear + correction;
    return {exponent, linear, correction + r * r * polynomial(exp_coefficients, r)};
}

// The value with `first` in place of 1, for |first| >= 0.5 or 0.
template <class R>
RDDL_ALWAYS_INLINE R value(const Exponential<R>& e, R first) {
    const Pair<R> sum = sum_exactly(first, e.linear);
    return scale(sum.high + (sum.low + e.rest), e.exponent);
}

// The value / 2^exponent + shift, for |shift| <= 1.
template <class R>
RDDL_ALWAYS_INLINE Pair<R> shifted(const Exponential<R>& e, R shift) {
    const Pair<R> first = sum_exactly(R{1.0}, shift);
    const Pair<R> sum = sum_exactly(first.high, e.linear);
    return {sum.high, sum.low + (first.low + e.rest)};
}

}  // namespace detail

template <RealLanes R>
R exp(R a) {
    const R bounded = detail::clamp(a, -750.0, 710.0);  // beyond, the result is 0 or infinity
    return detail::value(detail::exponential(bounded, R{0.0}), R{1.0});
}

// e^a - 1 = 2^k (1 - 2^-k + ...).
template <RealLanes R>
R exp_minus_one(R a) {
    const R bounded = detail::clamp(a, -40.0, 710.0);  // e^-40 is lost in rounding beside 1
    const auto e = detail::exponential(bounded, R{0.0});
    const R one = detail::power_of_two(-detail::clamp(e.exponent, -1000.0, 1000.0));
    const R result = detail::value(e, 1.0 - one);
    return select(absolute(a) < 0x1p-54, a, result);
}

}  // namespace rddl
