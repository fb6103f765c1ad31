// Building blocks of the elementary functions: sums of two reals, products without rounding,
// rounding to integers, powers of two and polynomials.
//
// T. J. Dekker, "A floating-point technique for extending the available precision", Numerische
// Mathematik 18 (1971), 224-242.
#pragma once

#include <rddl/lanes/real.hpp>

#include <cstddef>
#include <cstdint>

namespace rddl::detail {

inline constexpr std::uint64_t sign_bit = 0x8000'0000'0000'0000;
inline constexpr double greatest_real = 0x1.fffffffffffffp1023;

// The unevaluated sum high + low.
template <class R>
struct Pair {
    R high;
    R low;
};

// a + b without rounding, for |a| >= |b| or a = 0.
template <class R>
RDDL_ALWAYS_INLINE Pair<R> sum_exactly(R a, R b) {
    const R high = a + b;
    return {high, b - (high - a)};
}

// All but the last bits of the significand.
template <class R>
RDDL_ALWAYS_INLINE R without_last_bits(R a, int count) {
    return real_of_bits(bits_of(a) & (~std::uint64_t{0} << count));
}

// a * b up to 2^-105 of it, unless it overflows or nearly vanishes.
template <class R>
RDDL_ALWAYS_INLINE Pair<R> multiply_exactly(R a, R b) {
    const R a_high = without_last_bits(a, 27);
    const R b_high = without_last_bits(b, 27);
    const R a_low = a - a_high;
    const R b_low = b - b_high;
    const R high = a * b;
    return {high, ((a_high * b_high - high) + a_high * b_low + a_low * b_high) + a_low * b_low};
}

// The difference between sqrt(square) and `root`, its rounded value.
template <class R>
RDDL_ALWAYS_INLINE R lost_by_root(R square, R root) {
    const Pair<R> again = multiply_exactly(root, root);
    const R remainder = (square - again.high) - again.low;
    return remainder / select(root == 0.0, R{1.0}, 2.0 * root);
}

// The quotient of sums whose first part is the greater one; rounded nearly as if by one division.
template <class R>
RDDL_ALWAYS_INLINE R quotient(Pair<R> dividend, Pair<R> divisor) {
    const Pair<R> a = sum_exactly(dividend.high, dividend.low);
    const Pair<R> b = sum_exactly(divisor.high, divisor.low);
    const R reciprocal = 1.0 / b.high;
    const R first = a.high * reciprocal;
    const Pair<R> product = multiply_exactly(first, b.high);
    const R remainder = (a.high - product.high) - product.low + (a.low - first * b.low);
    return first + remainder * reciprocal;
}

// The integers around it are neighbours: adding it rounds to an integer, which then stands in the
// last bits, as two's complement.
inline constexpr double rounder = 0x1.8p52;

// Requires |a| < 2^51; halves go to the even neighbour.
template <class R>
RDDL_ALWAYS_INLINE R nearest_integer(R a) {
    return (a + rounder) - rounder;
}

// Requires an integer from -1022 to 1023.
template <class R>
RDDL_ALWAYS_INLINE R power_of_two(R exponent) {
    return real_of_bits((bits_of(exponent + rounder) + std::uint64_t{1023}) << 52);
}

// a 2^exponent for an integer from -2000 to 2000; rounds once if a is neither subnormal nor huge.
template <class R>
RDDL_ALWAYS_INLINE R scale(R a, R exponent) {
    const R scaled = a * power_of_two(exponent);
    const auto far = absolute(exponent) > 1000.0;
    if (!any(far)) return scaled;
    const R half = nearest_integer(0.5 * exponent);
    return select(far, a * power_of_two(half) * power_of_two(exponent - half), scaled);
}

// nan stays nan.
template <class R>
RDDL_ALWAYS_INLINE R clamp(R a, double lowest, double highest) {
    return select(a < lowest, R{lowest}, select(a > highest, R{highest}, a));
}

// `magnitude`, which is not negative, with the sign of `a`.
template <class R>
RDDL_ALWAYS_INLINE R with_sign_of(R a, R magnitude) {
    return real_of_bits(bits_of(magnitude) | (bits_of(a) & sign_bit));
}

// Evaluates by Estrin's scheme: p(x) = low(x) + x^half high(x), and so on. It has shorter chains of
// dependent operations than Horner's.
template <std::size_t first, std::size_t count, class Number, class R, std::size_t n,
          std::size_t powers>
RDDL_ALWAYS_INLINE R polynomial_part(const Number (&coefficients)[n],
                                     const R (&x_to_power_of_two)[powers]) {
    if constexpr (count == 1) {
        return R{coefficients[first]};
    } else {
        constexpr std::size_t log_half = static_cast<std::size_t>(std::bit_width(count - 1)) - 1;
        constexpr std::size_t half = std::size_t{1} << log_half;
        const R low = polynomial_part<first, half>(coefficients, x_to_power_of_two);
        const R high = polynomial_part<first + half, count - half>(coefficients, x_to_power_of_two);
        return low + high * x_to_power_of_two[log_half];
    }
}

// The coefficients are those of 1, x, x^2, ...
template <class Number, class R, std::size_t n>
RDDL_ALWAYS_INLINE R polynomial(const Number (&coefficients)[n], R x) {
    static_assert(n <= (FloatLanes<R> ? 12 : 16));
    const R square = x * x;
    const R fourth = square * square;
    if constexpr (FloatLanes<R> && n > 8) {
        // Without x^8, which is subnormal for floats below 2e-5: that takes a hundred cycles.
        const R powers[] = {x, square, fourth};
        return polynomial_part<0, 4>(coefficients, powers) +
               polynomial_part<4, n - 4>(coefficients, powers) * fourth;
    } else {
        const R powers[] = {x, square, fourth, fourth * fourth};
        return polynomial_part<0, n>(coefficients, powers);
    }
}

}  // namespace rddl::detail
