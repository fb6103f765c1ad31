// Natural logarithms.
#pragma once

#include <rddl/lanes/real.hpp>
#include <rddl/values/math/exponential.hpp>
#include <rddl/values/math/parts.hpp>

#include <cstdint>
#include <limits>

namespace rddl {

namespace detail {

// ln((1 + s) / (1 - s)) = 2 s + s z (2/3 + z p(z)) with z = s^2, for s up to that of sqrt 2, up to
// 2^-66 of it. From docs/mathematics/coefficients.py.
inline constexpr double ln_coefficients[] = {
    0.4000000000000238,  0.285714285700502,  0.22222222527612326, 0.18181783766942258,
    0.15386782389067485, 0.1325628252217302, 0.13200928214682742,
};

// 2^exponent significand, with the significand from sqrt(1/2) to sqrt(2).
template <class R>
struct Binary {
    R exponent;
    R significand;
};

// Requires a positive, finite a.
template <class R>
RDDL_ALWAYS_INLINE Binary<R> binary(R a) {
    constexpr std::uint64_t least_significand = bits_of(0.70710678118654752);
    const auto subnormal = a < 0x1p-1022;
    const R normal = select(subnormal, a * 0x1p54, a);
    // A carry from the significand makes the exponent that of the nearer power of two.
    const auto bits = bits_of(normal) + (bits_of(1.0) - least_significand);
    const R biased_exponent = real_of_bits((bits >> 52) | bits_of(0x1p52)) - 0x1p52;
    const R exponent = biased_exponent - select(subnormal, R{1023.0 + 54.0}, R{1023.0});
    return {exponent, real_of_bits((bits & 0x000f'ffff'ffff'ffff) + least_significand)};
}

// ln(a) + correction, for positive, finite a and a correction that is small beside ln(a).
//
// Let a = 2^k (1 + f) and s = f / (2 + f). Then ln(1 + f) = f - (f^2 / 2 - s (f^2 / 2 + z (...))):
// the great terms are computed without division, so without its rounding.
template <class R>
RDDL_ALWAYS_INLINE R ln_of_positive(R a, R correction) {
    const auto [exponent, significand] = binary(a);
    const R f = significand - 1.0;
    const R s = f / (2.0 + f);
    const R z = s * s;
    const R half_square = 0.5 * f * f;
    const R series = z * (2.0 / 3.0 + z * polynomial(ln_coefficients, z));
    const R small = s * (half_square + series) + (exponent * ln_2_low + correction);
    return exponent * ln_2_high - ((half_square - small) - f);
}

// `logarithm` where `a` is positive and finite; elsewhere that of zero, infinity, or nan.
template <class R>
RDDL_ALWAYS_INLINE R with_rare_logarithms(R a, R logarithm) {
    const auto ordinary = a > 0.0 && a <= greatest_real;
    if (!any(!ordinary)) return logarithm;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const R of_infinity_or_nan = select(a == infinity, a, R{infinity - infinity});
    return select(ordinary, logarithm, select(a == 0.0, R{-infinity}, of_infinity_or_nan));
}

}  // namespace detail

template <RealLanes R>
R ln(R a) {
    return detail::with_rare_logarithms(a, detail::ln_of_positive(a, R{0.0}));
}

template <RealLanes R>
R log(R a, R base) {
    return ln(a) / ln(base);
}

// ln(1 + a): the logarithm of the rounded sum, and of what rounding lost.
template <RealLanes R>
R ln_one_plus(R a) {
    const R sum = 1.0 + a;
    const R added = sum - 1.0;
    const R lost = (1.0 - (sum - added)) + (a - added);
    const R logarithm = detail::ln_of_positive(sum, lost / sum);
    return select(absolute(a) < 0x1p-54, a, detail::with_rare_logarithms(sum, logarithm));
}

}  // namespace rddl
