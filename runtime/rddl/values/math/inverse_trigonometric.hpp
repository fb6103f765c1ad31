// asin, acos, atan and atan2.
#pragma once

#include <rddl/lanes/real.hpp>
#include <rddl/values/math/parts.hpp>

#include <limits>

namespace rddl {

namespace detail {

inline constexpr Pair<double> half_pi{0x1.921fb54442d18p0, 0x1.1a62633145c07p-54};
inline constexpr Pair<double> quarter_pi{0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55};
inline constexpr Pair<double> atan_of_half{0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56};

// asin s = s + s z p(z) with z = s^2, for s <= 1/2, up to 2^-59 of it.
// From docs/mathematics/coefficients.py.
inline constexpr double asin_coefficients[] = {
    0.1666666666666676,   0.07499999999971084,  0.04464285717424165,  0.030381942728418904,
    0.02237221435454818,  0.017351623993933394, 0.013980672146778715, 0.011400151643391608,
    0.010773219158633699, 0.003733157988659024, 0.021642178518192026, -0.020906701043339845,
    0.03257098925264881,
};

// atan t = t + t z p(z) with z = t^2, for |t| <= tan(pi / 8), up to 2^-59 of it.
// From docs/mathematics/coefficients.py.
inline constexpr double atan_coefficients[] = {
    -0.33333333333333187, 0.199999999999512,   -0.14285714279992967,  0.11111110774550974,
    -0.090908975288639,   0.07692056526049987, -0.06663065650544724,  0.058476313278459605,
    -0.05038224365861292, 0.03803891545435764, -0.017880855586546687,
};

// The arc in [0, pi / 6] that asin and acos are made of: asin of a magnitude up to 1/2, else of the
// root of (1 - magnitude) / 2, which is the sine of half the arc from 1.
template <class R>
RDDL_ALWAYS_INLINE Pair<R> arc_of_sine(R magnitude) {
    const auto great = magnitude > 0.5;
    const R square = select(great, 0.5 * (1.0 - magnitude), magnitude * magnitude);
    const R root = sqrt(square);
    const R sine = select(great, root, magnitude);
    const R lost = select(great, lost_by_root(square, root), R{0.0});
    return {sine, lost + sine * (square * polynomial(asin_coefficients, square))};
}

// quarters pi / 2 + factor arc. The first is the greater one, or 0.
template <class R>
RDDL_ALWAYS_INLINE R turned(R quarters, R factor, Pair<R> arc) {
    const Pair<R> sum = sum_exactly(quarters * half_pi.high, factor * arc.high);
    return sum.high + (sum.low + quarters * half_pi.low + factor * arc.low);
}

// quarters pi / 2 + sign atan(a / b), for 0 <= a <= b, b > 0, both finite and not extreme:
// atan(a / b) = atan(c) + atan((a - c b) / (b + c a)), with c = 0, 1/2 or 1.
template <class R>
RDDL_ALWAYS_INLINE R turned_arc_of_tangent(R quarters, R sign, R a, R b) {
    const auto from_half = a > 0.4142 * b;
    const auto from_one = a > 0.7 * b;
    const auto choose = [&](double zero, double half, double one) {
        return select(from_one, R{one}, select(from_half, R{half}, R{zero}));
    };
    const R c = choose(0.0, 0.5, 1.0);
    const R t = (a - c * b) / (b + c * a);
    const R z = t * t;
    const R curvature = t * z * polynomial(atan_coefficients, z);
    const R base_high = choose(0.0, atan_of_half.high, quarter_pi.high);
    const R base_low = choose(0.0, atan_of_half.low, quarter_pi.low);
    const Pair<R> base = sum_exactly(quarters * half_pi.high, sign * base_high);
    const R low = base.low + quarters * half_pi.low + sign * base_low;
    const Pair<R> sum = sum_exactly(base.high, sign * t);
    return sum.high + (sum.low + (low + sign * curvature));
}

// The legs a <= b times the power of two that keeps b from overflow and underflow. Infinite legs,
// or two of 0, are replaced by legs of the same direction.
template <class R>
RDDL_ALWAYS_INLINE Pair<R> of_usual_size(R a, R b) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto tiny = b < 0x1p-500;
    const auto huge = b > 0x1p500;
    if (!any(tiny || huge)) return {a, b};
    const R factor = select(tiny, R{0x1p500}, select(huge, R{0x1p-500}, R{1.0}));
    const R part_of_infinity = select(a == infinity, R{1.0}, a * 0.0);
    return {select(b == infinity, part_of_infinity, a * factor),
            select(b == infinity || b == 0.0, R{1.0}, b * factor)};
}

}  // namespace detail

template <RealLanes R>
R asin(R a) {
    const R magnitude = absolute(a);
    const auto great = magnitude > 0.5;
    const R quarters = select(great, R{1.0}, R{0.0});
    const R factor = select(great, R{-2.0}, R{1.0});
    return detail::with_sign_of(a,
                                detail::turned(quarters, factor, detail::arc_of_sine(magnitude)));
}

template <RealLanes R>
R acos(R a) {
    const R magnitude = absolute(a);
    const auto great = magnitude > 0.5;
    const auto negative = a < 0.0;
    const R quarters = select(great, select(negative, R{2.0}, R{0.0}), R{1.0});
    const R sign = select(negative, R{-1.0}, R{1.0});
    const R factor = select(great, 2.0 * sign, -sign);
    return detail::turned(quarters, factor, detail::arc_of_sine(magnitude));
}

template <RealLanes R>
R atan(R a) {
    const R magnitude = detail::clamp(absolute(a), 0.0, 0x1p60);  // beyond, it rounds to pi / 2
    const auto steep = magnitude > 1.0;
    const R result = detail::turned_arc_of_tangent(
        select(steep, R{1.0}, R{0.0}), select(steep, R{-1.0}, R{1.0}),
        select(steep, R{1.0}, magnitude), select(steep, magnitude, R{1.0}));
    return detail::with_sign_of(a, result);
}

// The angle of the point (x, y), in [-pi, pi]; 0 for the origin.
template <RealLanes R>
R atan2(R y, R x) {
    const R height = absolute(y), width = absolute(x);
    const auto steep = height > width;
    const auto left = detail::with_sign_of(x, R{1.0}) < 0.0;
    const R quarters = select(steep, R{1.0}, select(left, R{2.0}, R{0.0}));
    const R sign = select((steep && !left) || (left && !steep), R{-1.0}, R{1.0});
    const auto [shorter, longer] =
        detail::of_usual_size(select(steep, width, height), select(steep, height, width));
    return detail::with_sign_of(y, detail::turned_arc_of_tangent(quarters, sign, shorter, longer));
}

}  // namespace rddl
