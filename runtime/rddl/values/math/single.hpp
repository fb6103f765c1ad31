// The functions of floats (binary32). The frequent ones have kernels of their own, after S.
// Moshier's Cephes library; doubles compute the others, which are then rounded, so nearly always
// the nearest float. Alone and in packs they give the same bits.
#pragma once

#include <rddl/lanes/real.hpp>
#include <rddl/values/math/exponential.hpp>
#include <rddl/values/math/hyperbolic.hpp>
#include <rddl/values/math/hypot.hpp>
#include <rddl/values/math/inverse_trigonometric.hpp>
#include <rddl/values/math/logarithm.hpp>
#include <rddl/values/math/parts.hpp>
#include <rddl/values/math/power.hpp>
#include <rddl/values/math/remainder.hpp>
#include <rddl/values/math/single_by_doubles.hpp>
#include <rddl/values/math/trigonometric.hpp>

#include <cstdint>
#include <limits>

namespace rddl {

// ------------------------------------------------------------------------ frequent ones

namespace detail::single {

// Adding it rounds to an integer, which then stands in the last bits.
inline constexpr float rounder = 0x1.8p23f;

template <class R>
RDDL_ALWAYS_INLINE R clamp(R a, float lowest, float highest) {
    return select(a < lowest, R{lowest}, select(a > highest, R{highest}, a));
}

// Requires an integer from -126 to 127.
template <class R>
RDDL_ALWAYS_INLINE R power_of_two(R exponent) {
    return real_of_bits((bits_of(exponent + rounder) + std::uint32_t{127}) << 23);
}

// Their sum is ln 2. Products of the first with exponents are exact.
inline constexpr float ln_2_high = 0.693359375f;
inline constexpr float ln_2_low = -2.12194440e-4f;

// e^r = 1 + r + r^2 p(r) for |r| <= ln(2) / 2.
inline constexpr float exp_coefficients[] = {5.0000001201e-1f, 1.6666665459e-1f, 4.1665795894e-2f,
                                             8.3334519073e-3f, 1.3981999507e-3f, 1.9875691500e-4f};

// ln(1 + f) = f - f^2 / 2 + f^3 p(f) for 1 + f from sqrt(1/2) to sqrt(2).
inline constexpr float ln_coefficients[] = {3.3333331174e-1f,  -2.4999993993e-1f, 2.0000714765e-1f,
                                            -1.6668057665e-1f, 1.4249322787e-1f,  -1.2420140846e-1f,
                                            1.1676998740e-1f,  -1.1514610310e-1f, 7.0376836292e-2f};

// ln(a 2^(127 - bias)), for positive, finite a that are not subnormal.
template <class R>
RDDL_ALWAYS_INLINE R ln_of_normal(R a, R bias) {
    constexpr std::uint32_t least_significand = bits_of(0.70710678f);
    const auto bits = bits_of(a) + (bits_of(1.0f) - least_significand);
    const R exponent = real_of_bits((bits >> 23) | bits_of(0x1p23f)) - (0x1p23f + bias);
    const R f = real_of_bits((bits & std::uint32_t{0x007F'FFFF}) + least_significand) - 1.0f;
    const R square = f * f;
    const R small = f * square * polynomial(ln_coefficients, f) + exponent * ln_2_low;
    return exponent * ln_2_high + (f + (small - 0.5f * square));
}

// Requires a positive, finite a.
template <class R>
RDDL_ALWAYS_INLINE R ln_of_positive(R a) {
    const auto subnormal = a < 0x1p-126f;
    return ln_of_normal(select(subnormal, a * 0x1p24f, a),
                        select(subnormal, R{127.0f + 24.0f}, R{127.0f}));
}

// Their sum is pi / 2; products of the first two with 13 bits are exact.
inline constexpr float half_pi_parts[] = {1.5703125f, 4.837512969970703125e-4f,
                                          7.54978995489188216e-8f};
inline constexpr float two_over_pi = 0.636619772367581f;
inline constexpr float greatest_near_angle = 0x1p13f;

// sin r = r + r z p(z) and cos r = 1 - z / 2 + z^2 p(z) with z = r^2, for |r| <= pi / 4.
inline constexpr float sin_coefficients[] = {-1.6666654611e-1f, 8.3321608736e-3f,
                                             -1.9515295891e-4f};
inline constexpr float cos_coefficients[] = {4.166664568298827e-2f, -1.388731625493765e-3f,
                                             2.443315711809948e-5f};

// The sine and the cosine of what remains of an angle without the whole quadrants, the number of
// which stands in the last bits of `quadrants`.
template <class R>
struct Circle {
    R sine;
    R cosine;
    R quadrants;
};

// Requires |a| <= greatest_near_angle.
template <class R>
RDDL_ALWAYS_INLINE Circle<R> near_circle(R a) {
    const R rounded = a * two_over_pi + rounder;
    const R quadrants = rounded - rounder;
    const R r = ((a - quadrants * half_pi_parts[0]) - quadrants * half_pi_parts[1]) -
                quadrants * half_pi_parts[2];
    const R z = r * r;
    return {r + r * (z * polynomial(sin_coefficients, z)),
            (1.0f - 0.5f * z) + z * z * polynomial(cos_coefficients, z), rounded};
}

// Requires |a| <= detail::greatest_angle. These are the functions of doubles, rounded, without what
// those do for the last two bits of a double: floats have 29 bits less.
template <class R>
RDDL_ALWAYS_INLINE Circle<R> far_circle(R a) {
    const auto [quadrants, r] = far_angle(to_double(a));
    const auto z = r * r;
    return {to_float(r + r * (z * polynomial(detail::sin_coefficients, z))),
            to_float((1.0 - 0.5 * z) + z * z * polynomial(detail::cos_coefficients, z)),
            real_of_bits(lower_halves(bits_of(quadrants)))};
}

// The sine of the angle and `quarters` right angles, an unsigned int or one in each lane.
template <class R, class Quarters>
RDDL_ALWAYS_INLINE R sine(const Circle<R>& circle, Quarters quarters) {
    const auto turns = bits_of(circle.quadrants) + quarters;
    const R magnitude = first_if_even(turns, circle.sine, circle.cosine);
    const auto sign = (turns << 30) & std::uint32_t{0x8000'0000};
    return real_of_bits(bits_of(magnitude) ^ sign);
}

// `result` where near_circle can reduce the angle; else the sine of it and `quarters` right angles,
// by doubles, and by their function where the angle is too great for that as well.
template <class R, class Function>
[[gnu::noinline]] R with_far_angles(R a, R result, std::uint32_t quarters, Function function) {
    const auto is_far = absolute(a) > greatest_near_angle;
    const R sines = select(is_far, sine(far_circle(a), quarters), result);
    const auto great = absolute(a) > float{detail::greatest_angle};
    if (!any(great)) return sines;
    return select(great, to_float(function(to_double(a))), sines);
}

}  // namespace detail::single

template <FloatLanes R>
R exp(R a) {
    using namespace detail::single;
    const R bounded = clamp(a, -105.0f, 100.0f);  // beyond, the result is 0 or infinity
    const R exponent = (bounded * 1.44269504f + rounder) - rounder;
    const R r = (bounded - exponent * ln_2_high) - exponent * ln_2_low;
    const R significand = 1.0f + (r + r * r * detail::polynomial(exp_coefficients, r));
    const R half = (0.5f * exponent + rounder) - rounder;
    return significand * power_of_two(half) * power_of_two(exponent - half);
}

template <FloatLanes R>
R ln(R a) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const R logarithm = detail::single::ln_of_positive(a);
    const auto ordinary = a > 0.0f && a <= std::numeric_limits<float>::max();
    if (!any(!ordinary)) return logarithm;
    const R of_infinity_or_nan = select(a == infinity, a, R{infinity - infinity});
    return select(ordinary, logarithm, select(a == 0.0f, R{-infinity}, of_infinity_or_nan));
}

// Inlined as those of doubles are: the sine and the cosine of an angle then share its circle.
template <FloatLanes R>
RDDL_ALWAYS_INLINE R sin(R a) {
    using namespace detail::single;
    const R result = sine(near_circle(a), std::uint32_t{0});
    const R near = select(absolute(a) < 0x1p-12f, a, result);
    if (!any(absolute(a) > greatest_near_angle)) [[likely]]
        return near;
    return with_far_angles(a, near, 0, [](auto x) { return sin(x); });
}
template <FloatLanes R>
RDDL_ALWAYS_INLINE R cos(R a) {
    using namespace detail::single;
    const R near = sine(near_circle(a), std::uint32_t{1});
    if (!any(absolute(a) > greatest_near_angle)) [[likely]]
        return near;
    return with_far_angles(a, near, 1, [](auto x) { return cos(x); });
}

// As that of doubles, with the same frequent exponents.
template <FloatLanes R>
R power(R base, R exponent) {
    const R square = base * base;
    const auto squares = exponent == 2.0f;
    if (!any(!squares)) return square;
    if (!any(!(exponent == 1.0f))) return base;
    if (!any(!(exponent == 0.5f))) return to_float(detail::root_power(to_double(base)));
    const auto result = detail::single::any_power(to_double(base), to_double(exponent));
    return select(squares, square, to_float(result));
}

template <FloatLanes R>
R tan(R a) {
    return to_float(detail::single::tangent(to_double(a)));
}
template <FloatLanes R>
R atan(R a) {
    return to_float(detail::single::arc_tangent(to_double(a)));
}

// The same bits as those of doubles, rounded. The quotient of floats is off by less than 0.2,
// so the rest after the nearest integer is less than the divisor; doubles compute it without
// rounding.
template <FloatLanes R>
R floor_mod(R a, R b) {
    constexpr float greatest_quotient = 0x1p21f;
    const auto sign = bits_of(b) & std::uint32_t{0x8000'0000};
    const R dividend = real_of_bits(bits_of(a) ^ sign);
    const R divisor = real_of_bits(bits_of(b) ^ sign);
    const R quotient = dividend / divisor;
    const auto ordinary =
        absolute(quotient) <= greatest_quotient && divisor <= std::numeric_limits<float>::max();
    if (any(!ordinary)) return to_float(floor_mod(to_double(a), to_double(b)));
    const R nearest = (quotient + detail::single::rounder) - detail::single::rounder;
    const auto rest = to_double(dividend) - to_double(nearest) * to_double(divisor);
    const auto remainder = select(rest < 0.0, rest + to_double(divisor), rest) + 0.0;  // no -0
    return real_of_bits(bits_of(to_float(remainder)) ^ sign);
}

// -------------------------------------------------------------------------- the others

#define RDDL_OF_FLOATS(function)                 \
    template <FloatLanes R>                      \
    R function(R a) {                            \
        return to_float(function(to_double(a))); \
    }
RDDL_OF_FLOATS(exp_minus_one)
RDDL_OF_FLOATS(ln_one_plus)
RDDL_OF_FLOATS(asin)
RDDL_OF_FLOATS(acos)
RDDL_OF_FLOATS(sinh)
RDDL_OF_FLOATS(cosh)
RDDL_OF_FLOATS(tanh)
#undef RDDL_OF_FLOATS

#define RDDL_OF_FLOATS(function)                               \
    template <FloatLanes R>                                    \
    R function(R a, R b) {                                     \
        return to_float(function(to_double(a), to_double(b))); \
    }
RDDL_OF_FLOATS(log)
RDDL_OF_FLOATS(atan2)
RDDL_OF_FLOATS(hypot)
#undef RDDL_OF_FLOATS

}  // namespace rddl
