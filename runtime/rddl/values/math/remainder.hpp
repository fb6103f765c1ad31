// The remainder of division: exact, but rounded once where a divisor is added to it.
#pragma once

#include <rddl/lanes/real.hpp>
#include <rddl/values/math/parts.hpp>

#include <cmath>

namespace rddl {

namespace detail {

// The limit of exact products below: greater quotients, and divisors near the least and the
// greatest reals, would make one of them inexact.
inline constexpr double greatest_quotient = 0x1p26;
inline constexpr double least_divisor = 0x1p-900;
inline constexpr double greatest_divisor = 0x1p900;

// a - n b, rounded once, for n = floor(a / b) or one more. n has few bits, so that its products
// with the halves of b are exact, and n b is near a.
template <class R>
RDDL_ALWAYS_INLINE R rest_after(R a, R n, R b) {
    const R b_high = without_last_bits(b, 27);
    const R product = n * b;
    const R lost = (n * b_high - product) + n * (b - b_high);
    return (a - product) - lost;
}

}  // namespace detail

// Has the sign of the divisor, unlike C's; by 0 gives nan.
template <RealLanes R>
RDDL_ALWAYS_INLINE R floor_mod(R a, R b) {
    // The remainder of -a and -b is the negative one.
    const auto sign = bits_of(b) & detail::sign_bit;
    const R dividend = real_of_bits(bits_of(a) ^ sign);
    const R divisor = real_of_bits(bits_of(b) ^ sign);
    const R quotient = dividend / divisor;
    const R nearest = detail::nearest_integer(quotient);
    const R n = select(nearest > quotient, nearest - 1.0, nearest);
    R rest = detail::rest_after(dividend, n, divisor);
    const auto ordinary = absolute(quotient) <= detail::greatest_quotient &&
                          divisor >= detail::least_divisor && divisor <= detail::greatest_divisor;
    if (any(!ordinary))
        rest = select(ordinary, rest, map_lanes(dividend, divisor, [](double x, double y) {
                          return std::fmod(x, y);
                      }));
    // Negative if C's, or if the quotient was rounded up to an integer.
    const R remainder = select(rest < 0.0, rest + divisor, rest) + 0.0;  // no -0
    return real_of_bits(bits_of(remainder) ^ sign);
}

}  // namespace rddl
