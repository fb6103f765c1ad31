// sin, cos and tan.
#pragma once

#include <rddl/lanes/real.hpp>
#include <rddl/values/math/parts.hpp>

#include <cmath>
#include <cstdint>
#include <utility>

namespace rddl {

namespace detail {

inline constexpr double two_over_pi = 0x1.45f306dc9c883p-1;
// Their sum is pi / 2. The first three have 29 bits, so that products with 24 bits are exact.
inline constexpr double half_pi_parts[] = {0x1.921fb54p0, 0x1.10b4612p-30, -0x1.676733bp-60,
                                           0x1.701b839a25205p-92};
// Greater arguments go to the C library.
inline constexpr double greatest_angle = 0x1p24;

// sin r = r + r z p(z) and cos r = 1 - z / 2 + z^2 p(z) with z = r^2, for |r| <= pi / 4, up to
// 2^-57 of sin r and 2^-64. From docs/mathematics/coefficients.py.
inline constexpr double sin_coefficients[] = {
    -0.1666666666666663,    0.008333333333321974,   -0.000198412698295229,
    2.7557313608031443e-06, -2.505074662800555e-08, 1.5896201015007677e-10,
};
inline constexpr double cos_coefficients[] = {
    0.041666666666666595,   -0.001388888888887346,  2.4801587289117557e-05,
    -2.755731425783967e-07, 2.0875711572673512e-09, -1.13590895051783e-11,
};

// An angle: quadrants pi / 2 + rest. Only the last two bits of `quadrants` mean anything.
template <class R>
struct Angle {
    decltype(bits_of(std::declval<R>())) quadrants;
    Pair<R> rest;
};

// W. J. Cody, W. Waite, "Software manual for the elementary functions" (1980): subtracts the parts
// of pi / 2 one by one. Of |a| <= greatest_angle at least 2^-61 remains, and the only product
// that is rounded is below 2^-68.
template <class R>
RDDL_ALWAYS_INLINE Angle<R> angle(R a) {
    const R rounded = a * two_over_pi + rounder;
    const R quadrants = rounded - rounder;
    const R first = a - quadrants * half_pi_parts[0];
    const Pair<R> second = sum_exactly(first, -(quadrants * half_pi_parts[1]));
    const Pair<R> third = sum_exactly(second.high, -(quadrants * half_pi_parts[2]));
    const R low = second.low + third.low - quadrants * half_pi_parts[3];
    return {bits_of(rounded), sum_exactly(third.high, low)};
}

// The sine of high + low, |high| <= pi / 4.
template <class R>
RDDL_ALWAYS_INLINE Pair<R> sine(Pair<R> a) {
    const R z = a.high * a.high;
    return {a.high, a.low + z * (a.high * polynomial(sin_coefficients, z) - 0.5 * a.low)};
}
template <class R>
RDDL_ALWAYS_INLINE Pair<R> cosine(Pair<R> a) {
    const R z = a.high * a.high;
    const Pair<R> head = sum_exactly(R{1.0}, -0.5 * z);
    return {head.high, head.low + (z * z * polynomial(cos_coefficients, z) - a.high * a.low)};
}

// Negated where the given bit is set.
template <class R, class Bits>
RDDL_ALWAYS_INLINE R negated_by_bit(Bits bits, int place, R a) {
    return real_of_bits(bits_of(a) ^ ((bits << (63 - place)) & sign_bit));
}

// `result` for angles that `angle` can reduce, else that of the C library's function.
template <class R, class Function>
RDDL_ALWAYS_INLINE R with_great_angles(R a, R result, Function function) {
    const auto great = absolute(a) > greatest_angle;
    if (!any(great)) [[likely]]
        return result;
    return replace_lanes(great, a, result, function);
}

}  // namespace detail

// These two are inlined, since a sine is often wanted beside the cosine of the same angle, which is
// then reduced once.
template <RealLanes R>
RDDL_ALWAYS_INLINE R sin(R a) {
    const auto [quadrants, rest] = detail::angle(a);
    const auto s = detail::sine(rest);
    const auto c = detail::cosine(rest);
    const R magnitude = first_if_even(quadrants, s.high + s.low, c.high + c.low);
    const R result = detail::negated_by_bit(quadrants, 1, magnitude);
    return detail::with_great_angles(a, select(absolute(a) < 0x1p-27, a, result),
                                     [](double x) { return std::sin(unknown(x)); });
}

template <RealLanes R>
RDDL_ALWAYS_INLINE R cos(R a) {
    const auto [quadrants, rest] = detail::angle(a);
    const auto s = detail::sine(rest);
    const auto c = detail::cosine(rest);
    const R magnitude = first_if_even(quadrants, c.high + c.low, s.high + s.low);
    const R result = detail::negated_by_bit(quadrants + std::uint64_t{1}, 1, magnitude);
    return detail::with_great_angles(a, result, [](double x) { return std::cos(unknown(x)); });
}

template <RealLanes R>
R tan(R a) {
    const auto [quadrants, rest] = detail::angle(a);
    const auto s = detail::sine(rest);
    const auto c = detail::cosine(rest);
    const detail::Pair<R> dividend{first_if_even(quadrants, s.high, c.high),
                                   first_if_even(quadrants, s.low, c.low)};
    const detail::Pair<R> divisor{first_if_even(quadrants, c.high, s.high),
                                  first_if_even(quadrants, c.low, s.low)};
    const R result = detail::negated_by_bit(quadrants, 0, detail::quotient(dividend, divisor));
    return detail::with_great_angles(a, select(absolute(a) < 0x1p-27, a, result),
                                     [](double x) { return std::tan(unknown(x)); });
}

}  // namespace rddl
