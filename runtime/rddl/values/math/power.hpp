// Powers of reals: e^(exponent ln base), with the logarithm as a sum of two reals.
#pragma once

#include <rddl/lanes/real.hpp>
#include <rddl/values/math/exponential.hpp>
#include <rddl/values/math/logarithm.hpp>
#include <rddl/values/math/parts.hpp>

#include <limits>

namespace rddl {

namespace detail {

// s = f / (2 + f) for 1 + f = significand: 16 bits, and the rest up to 2^-66 of s.
template <class R>
RDDL_ALWAYS_INLINE Pair<R> half_angle(R significand) {
    const R f = significand - 1.0;
    const R divisor = significand + 1.0;
    const R reciprocal = 1.0 / divisor;
    const R high = without_last_bits(f * reciprocal, 37);
    const R divisor_high = without_last_bits(divisor, 16);
    const R divisor_low = (divisor - divisor_high) + (significand - (divisor - 1.0));
    const R remainder = (f - high * divisor_high) - high * divisor_low;
    return {high, remainder * reciprocal};
}

// ln(a) up to 2^-62 of it, for positive, finite a: the series of ln_of_positive, where the terms
// 2 s and 2/3 s^3 need more than a double. The cube of the 16 bits of s and its product with 21/32,
// which is 2/3 - 1/96, are exact.
template <class R>
RDDL_ALWAYS_INLINE Pair<R> ln_as_pair(R a) {
    const auto [exponent, significand] = binary(a);
    const auto [s_high, s_low] = half_angle(significand);
    const R s = s_high + s_low;
    const R z = s * s;
    const R cube = s_high * s_high * s_high;
    const R rest_of_cube =
        2.0 * s_low * (s_high * s + s_low * s_low * (1.0 / 3.0)) + cube * (1.0 / 96.0);
    const R series = s * (z * z * polynomial(ln_coefficients, z));
    const Pair<R> head = sum_exactly(2.0 * s_high, cube * (21.0 / 32.0));
    const Pair<R> whole = sum_exactly(exponent * ln_2_high, head.high);
    const R tail = 2.0 * s_low + (rest_of_cube + series);
    return sum_exactly(whole.high, whole.low + (head.low + tail + exponent * ln_2_low));
}

// Requires a positive, finite base.
template <class R>
RDDL_ALWAYS_INLINE R power_of_positive(R base, R exponent) {
    const Pair<R> logarithm = ln_as_pair(base);
    // Beyond, powers of all bases but 1 are 0 or infinity.
    const R bounded = clamp(exponent, -0x1p80, 0x1p80);
    const Pair<R> product = multiply_exactly(logarithm.high, bounded);
    const R low = product.low + logarithm.low * bounded;
    const R high = clamp(product.high, -750.0, 710.0);
    return value(exponential(high, select(high == product.high, low, R{0.0})), R{1.0});
}

// All reals from 2^52 on are integers.
template <class R>
RDDL_ALWAYS_INLINE auto is_integer(R a) {
    const R magnitude = absolute(a);
    return magnitude >= 0x1p52 || (magnitude + 0x1p52) - 0x1p52 == magnitude;
}

// IEEE's pow for bases that are zero, negative, infinite or nan, and for exponents that are nan.
// `of_magnitude` is the power of a negative base's magnitude.
template <class R>
RDDL_ALWAYS_INLINE R rare_power(R base, R exponent, R of_magnitude) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const R magnitude = absolute(base);
    const auto odd = is_integer(exponent) && !is_integer(0.5 * exponent);
    const auto no_root = base < 0.0 && magnitude != infinity && !is_integer(exponent);
    const R of_zero = select(exponent < 0.0, R{infinity}, R{0.0});
    const R of_infinity = select(exponent < 0.0, R{0.0}, R{infinity});
    R result = select(magnitude == 0.0, of_zero, of_magnitude);
    result = select(magnitude == infinity, of_infinity, result);
    result = select(odd, with_sign_of(base, result), result);
    result =
        select(no_root || base != base || exponent != exponent, R{infinity - infinity}, result);
    return select(exponent == 0.0 || base == 1.0, R{1.0}, result);
}

// The power with exponent 0.5: the nearest double to the root, where IEEE's pow differs by its zero
// and by infinite bases.
template <class R>
RDDL_ALWAYS_INLINE R root_power(R base) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const R magnitude = select(base < 0.0, R{infinity - infinity}, base + 0.0);
    return sqrt(select(base == -infinity, R{infinity}, magnitude));
}

// The power if the exponents are not all 2, nor all 1, nor all 0.5.
template <class R>
R any_power(R base, R exponent) {
    const auto roots = exponent == 0.5;
    if (any(roots))
        return select(roots, root_power(base), any_power(base, select(roots, R{1.0}, exponent)));
    const R result = power_of_positive(absolute(base), exponent);
    const auto firsts = exponent == 1.0, squares = exponent == 2.0;
    const auto ordinary = base > 0.0 && base <= greatest_real && exponent == exponent;
    const R chosen = select(firsts, base, select(squares, base * base, result));
    if (!any(!ordinary)) return chosen;
    return select(ordinary || firsts || squares, chosen, rare_power(base, exponent, result));
}

}  // namespace detail

// A constant 2 is by far the most frequent exponent, before 0.5, and 1 where distributions take the
// reciprocal of a shape.
template <RealLanes R>
RDDL_ALWAYS_INLINE R power(R base, R exponent) {
    if (!any(!(exponent == 2.0))) return base * base;
    if (!any(!(exponent == 1.0))) return base;
    if (!any(!(exponent == 0.5))) return detail::root_power(base);
    return detail::any_power(base, exponent);
}

}  // namespace rddl
