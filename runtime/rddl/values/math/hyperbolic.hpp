// sinh, cosh and tanh, of e^|a| as the sum of 2^k and small terms.
#pragma once

#include <rddl/lanes/real.hpp>
#include <rddl/values/math/exponential.hpp>
#include <rddl/values/math/parts.hpp>

namespace rddl {

// Computes (u + u / (u + 1)) / 2 with u = e^|a| - 1.
template <RealLanes R>
R sinh(R a) {
    const R magnitude = absolute(a);
    const auto e = detail::exponential(detail::clamp(magnitude, 0.0, 711.0), R{0.0});
    const R one = detail::power_of_two(-detail::clamp(e.exponent, 0.0, 1000.0));
    const auto u = detail::shifted(e, -one);
    const R fraction = one * detail::quotient(u, detail::shifted(e, R{0.0}));
    const auto sum = detail::sum_exactly(u.high, fraction);
    const R result = detail::scale(sum.high + (sum.low + u.low), e.exponent - 1.0);
    return select(magnitude < 0x1p-28, a, detail::with_sign_of(a, result));
}

// (e^|a| + e^-|a|) / 2.
template <RealLanes R>
R cosh(R a) {
    const auto e = detail::exponential(detail::clamp(absolute(a), 0.0, 711.0), R{0.0});
    const R one = detail::power_of_two(-detail::clamp(e.exponent, 0.0, 500.0));
    const auto growing = detail::shifted(e, R{0.0});
    const R falling = one * one / (growing.high + growing.low);
    const auto sum = detail::sum_exactly(growing.high, falling);
    return detail::scale(sum.high + (sum.low + growing.low), e.exponent - 1.0);
}

// (e^2|a| - 1) / (e^2|a| + 1), both divided by 2^k.
template <RealLanes R>
R tanh(R a) {
    const R magnitude = absolute(a);
    const R bounded = detail::clamp(2.0 * magnitude, 0.0, 44.0);  // beyond, it rounds to 1
    const auto e = detail::exponential(bounded, R{0.0});
    const R one = detail::power_of_two(-e.exponent);
    const R result = detail::quotient(detail::shifted(e, -one), detail::shifted(e, one));
    return select(magnitude < 0x1p-28, a, detail::with_sign_of(a, result));
}

}  // namespace rddl
