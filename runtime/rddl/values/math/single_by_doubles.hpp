// Functions of floats that doubles compute and that are then rounded: with shorter polynomials than
// those of doubles, good to 2^-33 at least, so that a result is within 0.51 ulp of a float.
#pragma once

#include <rddl/lanes/real.hpp>
#include <rddl/values/math/inverse_trigonometric.hpp>
#include <rddl/values/math/logarithm.hpp>
#include <rddl/values/math/parts.hpp>
#include <rddl/values/math/power.hpp>
#include <rddl/values/math/trigonometric.hpp>

#include <cmath>

namespace rddl::detail::single {

// J. H. Lambert's continued fraction: tan r = r p(z) / q(z) with z = r^2, up to 2^-42 of it for
// |r| <= pi / 4.
inline constexpr double tan_dividend[] = {135135, -17325, 378, -1};
inline constexpr double tan_divisor[] = {135135, -62370, 3150, -28};

// atan t = t + t z p(z) with z = t^2, for |t| <= tan(pi / 8), up to 2^-35 of it.
// From docs/mathematics/coefficients.py.
inline constexpr double atan_coefficients[] = {
    -0.33333332468019977, 0.19999901736276046,  -0.14281955299727278,
    0.11044119866804823,  -0.08473383609117145, 0.047385603852134965,
};

// The logarithm to base 2 of (1 + s) / (1 - s) is s p(z) with z = s^2, for s up to that of sqrt 2,
// up to 2^-45 of it. From docs/mathematics/coefficients.py.
inline constexpr double log_2_coefficients[] = {
    2.88539008177785,   0.9617966941132957, 0.5770779423828805,
    0.4122092505816506, 0.3199057640707541, 0.2828993189966228,
};

// 2^g = 1 + g p(g) for |g| <= 1/2, up to 2^-34 of it. From docs/mathematics/coefficients.py.
inline constexpr double exp_2_coefficients[] = {
    0.6931471807891697,    0.2402265107220276,     0.05550410157429215,    0.009618037483930754,
    0.0013334080147993901, 0.00015466930715835357, 1.5165794997842649e-05,
};

// This is pi / 2 without its first part for doubles.
inline constexpr double half_pi_rest = detail::half_pi_parts[1] + detail::half_pi_parts[2];

// All of them are for doubles that are floats, alone or in packs.

// An angle: whole quadrants, the number of which stands in the last bits, and what remains.
// Requires |a| <= detail::greatest_angle.
template <class R>
struct FarAngle {
    R quadrants;
    R rest;
};
template <class R>
RDDL_ALWAYS_INLINE FarAngle<R> far_angle(R a) {
    const R rounded = a * detail::two_over_pi + detail::rounder;
    const R quadrants = rounded - detail::rounder;
    return {rounded, (a - quadrants * detail::half_pi_parts[0]) - quadrants * half_pi_rest};
}

template <class R>
RDDL_ALWAYS_INLINE R tangent(R a) {
    const auto [quadrants, r] = far_angle(a);
    const R z = r * r;
    const R dividend = r * polynomial(tan_dividend, z), divisor = polynomial(tan_divisor, z);
    const auto turns = bits_of(quadrants);
    const R quotient =
        first_if_even(turns, dividend, -divisor) / first_if_even(turns, divisor, dividend);
    return detail::with_great_angles(a, quotient, [](double x) { return std::tan(unknown(x)); });
}

// atan a = pi / 2 - atan(1 / a) and atan a = pi / 4 + atan((a - 1) / (a + 1)).
template <class R>
RDDL_ALWAYS_INLINE R arc_tangent(R a) {
    const R magnitude = detail::clamp(absolute(a), 0.0, 0x1p60);  // beyond, it rounds to pi / 2
    const auto steep = magnitude > 1.0;
    const R rise = select(steep, R{1.0}, magnitude), run = select(steep, magnitude, R{1.0});
    const auto diagonal = rise > 0.4142 * run;
    const R t = select(diagonal, rise - run, rise) / select(diagonal, rise + run, run);
    const R z = t * t;
    const R arc = t + t * (z * polynomial(atan_coefficients, z));
    const R from = select(diagonal, R{quarter_pi.high}, select(steep, R{half_pi.high}, R{0.0}));
    return detail::with_sign_of(a, from + select(steep, -arc, arc));
}

// Requires a positive, finite base.
template <class R>
RDDL_ALWAYS_INLINE R power_of_positive(R base, R exponent) {
    const auto [exponent_of_2, significand] = detail::binary(base);
    const R s = (significand - 1.0) / (significand + 1.0);
    const R logarithm = exponent_of_2 + s * polynomial(log_2_coefficients, s * s);
    // Beyond, powers of all bases but 1 are 0 or infinity, and so are floats beyond 2^product.
    const R bounded = detail::clamp(exponent, -0x1p80, 0x1p80);
    const R product = detail::clamp(bounded * logarithm, -160.0, 140.0);
    const R whole = nearest_integer(product);
    const R g = product - whole;
    return (1.0 + g * polynomial(exp_2_coefficients, g)) * detail::power_of_two(whole);
}

// The power if the exponents are not all 2. Roots are rounded as `sqrt` rounds them.
template <class R>
RDDL_ALWAYS_INLINE R any_power(R base, R exponent) {
    const R result = power_of_positive(absolute(base), exponent);
    const auto roots = exponent == 0.5;
    const auto ordinary = base > 0.0 && base <= greatest_real && exponent == exponent && !roots;
    if (!any(!ordinary)) return result;
    const R rare = select(roots, root_power(base), rare_power(base, exponent, result));
    return select(ordinary, result, rare);
}

}  // namespace rddl::detail::single
