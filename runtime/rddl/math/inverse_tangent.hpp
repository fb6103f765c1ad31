// atan.
#pragma once

#include <rddl/math/parts.hpp>
#include <rddl/real.hpp>

namespace rddl {

namespace detail {

// atan t = t + t z p(z) with z = t^2, for |t| <= tan(pi / 8), up to 2^-59 of it.
// From docs/mathematics/coefficients.py.
inline constexpr double atan_coefficients[] = {
    -0.33333333333333187, 0.199999999999512,   -0.14285714279992967,  0.11111110774550974,
    -0.090908975288639,   0.07692056526049987, -0.06663065650544724,  0.058476313278459605,
    -0.05038224365861292, 0.03803891545435764, -0.017880855586546687,
};

}  // namespace detail

// atan(x) = atan(c) + atan((x - c) / (1 + c x)), with c = 0, 1/2, 1 or infinity.
template <RealLanes R>
R atan(R a) {
    const R x = absolute(a);
    const auto from_half = x > 0.4142, from_one = x > 0.7, great = x > 2.4142;
    const auto choose = [&](double zero, double half, double one, double infinity) {
        const R below_great = select(from_one, R{one}, select(from_half, R{half}, R{zero}));
        return select(great, R{infinity}, below_great);
    };
    const R c = choose(0.0, 0.5, 1.0, 0.0);
    const R t = select(great, R{-1.0}, x - c) / select(great, x, 1.0 + c * x);
    const R z = t * t;
    const R curvature = t * z * detail::polynomial(detail::atan_coefficients, z);
    const R high = choose(0.0, 0x1.dac670561bb4fp-2, 0x1.921fb54442d18p-1, 0x1.921fb54442d18p0);
    const R low = choose(0.0, 0x1.a2b7f222f65e2p-56, 0x1.1a62633145c07p-55, 0x1.1a62633145c07p-54);
    const auto sum = detail::sum_exactly(high, t);
    return detail::with_sign_of(a, sum.high + (sum.low + low + curvature));
}

}  // namespace rddl
