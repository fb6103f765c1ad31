// The inverse of the standard normal distribution function.
// M. Wichura, Algorithm AS 241 (PPND16), Applied Statistics 37 (1988), 477-484; relative error
// about 1e-16.
#pragma once

#include <rddl/lanes/real.hpp>
#include <rddl/values/math.hpp>
#include <rddl/values/pack_ops.hpp>

#include <bit>
#include <cstdint>

namespace rddl {

namespace detail {

template <class R>
struct Fraction {
    R dividend;
    R divisor;
};

// Within 0.425 of the median, for q = p - 1/2.
template <class R>
RDDL_ALWAYS_INLINE Fraction<R> normal_quantile_centre(R q) {
    constexpr double numerator[] = {3.3871328727963666080e0, 1.3314166789178437745e2,
                                    1.9715909503065514427e3, 1.3731693765509461125e4,
                                    4.5921953931549871457e4, 6.7265770927008700853e4,
                                    3.3430575583588128105e4, 2.5090809287301226727e3};
    constexpr double denominator[] = {1.0,
                                      4.2313330701600911252e1,
                                      6.8718700749205790830e2,
                                      5.3941960214247511077e3,
                                      2.1213794301586595867e4,
                                      3.9307895800092710610e4,
                                      2.8729085735721942674e4,
                                      5.2264952788528545610e3};
    const R r = 0.180625 - q * q;
    return {q * polynomial(numerator, r), polynomial(denominator, r)};
}

// The tail for r = sqrt(-ln(tail probability)) up to 5, and beyond.
template <class R>
RDDL_ALWAYS_INLINE Fraction<R> normal_quantile_tail(R r) {
    constexpr double numerator[] = {1.42343711074968357734e0,  4.63033784615654529590e0,
                                    5.76949722146069140550e0,  3.64784832476320460504e0,
                                    1.27045825245236838258e0,  2.41780725177450611770e-1,
                                    2.27238449892691845833e-2, 7.74545014278341407640e-4};
    constexpr double denominator[] = {1.0,
                                      2.05319162663775882187e0,
                                      1.67638483018380384940e0,
                                      6.89767334985100004550e-1,
                                      1.48103976427480074590e-1,
                                      1.51986665636164571966e-2,
                                      5.47593808499534494600e-4,
                                      1.05075007164441684324e-9};
    return {polynomial(numerator, r - 1.6), polynomial(denominator, r - 1.6)};
}
template <class R>
RDDL_ALWAYS_INLINE Fraction<R> normal_quantile_far_tail(R r) {
    constexpr double numerator[] = {6.65790464350110377720e0,  5.46378491116411436990e0,
                                    1.78482653991729133580e0,  2.96560571828504891230e-1,
                                    2.65321895265761230930e-2, 1.24266094738807843860e-3,
                                    2.71155556874348757815e-5, 2.01033439929228813265e-7};
    constexpr double denominator[] = {1.0,
                                      5.99832206555887937690e-1,
                                      1.36929880922735805310e-1,
                                      1.48753612908506148525e-2,
                                      7.86869131145613259100e-4,
                                      1.84631831751005468180e-5,
                                      1.42151175831644588870e-7,
                                      2.04426310338993978564e-15};
    return {polynomial(numerator, r - 5.0), polynomial(denominator, r - 5.0)};
}

template <class R, class Mask>
RDDL_ALWAYS_INLINE Fraction<R> select_fraction(Mask mask, const Fraction<R>& a,
                                               const Fraction<R>& b) {
    return {select(mask, a.dividend, b.dividend), select(mask, a.divisor, b.divisor)};
}

// Farther from the median.
template <class R>
RDDL_ALWAYS_INLINE Fraction<R> normal_quantile_outside(R p, R q) {
    // The logarithm of an ordinary number.
    const R r = sqrt(-ln_of_positive(select(q < 0.0, p, 1.0 - p), R{0.0}));
    const auto far = r > 5.0;  // once in 4e10 draws
    Fraction<R> tail = normal_quantile_tail(r);
    if (any(far)) tail = select_fraction(far, normal_quantile_far_tail(r), tail);
    return {with_sign_of(q, tail.dividend), tail.divisor};
}

template <class Real>
RDDL_ALWAYS_INLINE auto is_central(const Real& q) {
    return absolute(q) <= 0.425;
}

// The lanes that are far from the median, 8 at most, in one register.
template <int n>
RDDL_ALWAYS_INLINE Lanes<double, n> normal_quantile_of_few_outside(const Lanes<double, n>& p,
                                                                   Mask<n> outside) {
    const Fraction<Lanes<double, n>> centre = normal_quantile_centre(p - 0.5);
    Lanes<double, n> result = centre.dividend / centre.divisor;
    if (any(outside)) {
        const Lanes<double, 8> some = compress(outside, p, 0.5);
        const Fraction<Lanes<double, 8>> tail = normal_quantile_outside(some, some - 0.5);
        expand(outside, tail.dividend / tail.divisor, result);
    }
    return result;
}

}  // namespace detail

// p in (0, 1).
template <RealLanes R>
R normal_quantile(R p) {
    const R q = p - 0.5;
    const auto central = detail::is_central(q);
    detail::Fraction<R> result = detail::normal_quantile_centre(q);
    if (any(!central))
        result = select_fraction(central, result, detail::normal_quantile_outside(p, q));
    return result.dividend / result.divisor;
}

// 15 of 100 lanes are far from the median. Those of several registers are brought together;
// otherwise 8 lanes are computed at a time.
template <int n>
requires(n > 8) Lanes<double, n> normal_quantile(const Lanes<double, n>& p) {
    const Mask<n> outside = !detail::is_central(p - 0.5);
    if (std::popcount(outside.bits) <= 8) return detail::normal_quantile_of_few_outside(p, outside);
    Lanes<double, n> result;
    constexpr int parts = Lanes<double, 8>::part_count;
    for (int first = 0; first < p.part_count; first += parts) {
        Lanes<double, 8> some;
        for (int i = 0; i < parts; ++i) some.part[i] = p.part[first + i];
        some = normal_quantile(some);
        for (int i = 0; i < parts; ++i) result.part[first + i] = some.part[i];
    }
    return result;
}

namespace detail {

// The first `count` numbers, which are far from the median, in as many lanes at a time as pay.
template <int lanes>
RDDL_ALWAYS_INLINE void replace_by_tails(double* numbers) {
    using Some = Lanes<double, lanes>;
    const Some p = Some::load(numbers);
    const Fraction<Some> tail = normal_quantile_outside(p, p - 0.5);
    (tail.dividend / tail.divisor).store(numbers);
}

}  // namespace detail

// Replaces packs of p in (0, 1), `most` at most. Their lanes that are far from the median share
// registers, since the tail takes much longer than the centre.
template <std::uint32_t most, int n>
[[gnu::noinline]] void replace_by_normal_quantiles(Lanes<double, n>* packs, std::uint32_t count) {
    constexpr int part_width = simd::lanes_of<double>;
    double far[most * n + 16];
    Mask<n> outside[most];
    int far_count = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Lanes<double, n> q = packs[i] - 0.5;
        outside[i] = !detail::is_central(q);
        const detail::Fraction<Lanes<double, n>> centre = detail::normal_quantile_centre(q);
        for (int p = 0; p < packs[i].part_count; ++p)
            far_count += simd::store_chosen(
                static_cast<simd::MaskBits>(outside[i].bits >> (p * part_width)) &
                    simd::all_lanes_of<double>,
                packs[i].part[p], far + far_count);
        packs[i] = centre.dividend / centre.divisor;
    }
    Lanes<double, 16>(0.5).store(far + far_count);
    int done = 0;
    for (; far_count - done > 8; done += 16) detail::replace_by_tails<16>(far + done);
    if (far_count > done) detail::replace_by_tails<8>(far + done);
    const double* next = far;
    for (std::uint32_t i = 0; i < count; ++i)
        for (int p = 0; p < packs[i].part_count; ++p)
            next +=
                simd::load_chosen(static_cast<simd::MaskBits>(outside[i].bits >> (p * part_width)) &
                                      simd::all_lanes_of<double>,
                                  next, packs[i].part[p]);
}

namespace detail::single {

// The quantile of p is (p - 1/2) f(w) with w = -ln(4 p (1 - p)), as in M. Giles, "Approximating the
// erfinv function", GPU Computing Gems, Jade Edition (2011), 109-116. f is a polynomial of w - 2.5
// up to 5, up to 2^-25 of it, and then one of sqrt(w) - 3 up to 16, up to 2^-23. From
// docs/mathematics/coefficients.py.
inline constexpr float quantile_coefficients[] = {
    4.24662685f,      0.697604001f,     -0.0118152145f,  -0.00354314223f, 0.00061744533f,
    -1.41200553e-05f, -9.76722094e-06f, 1.33559411e-06f, 6.38129336e-08f, -2.60635673e-08f,
};
inline constexpr float quantile_tail_coefficients[] = {
    8.01286888f,    2.83316231f,    0.0266952235f,   -0.021561075f,    0.0162424147f,
    -0.0103854388f, 0.00380171859f, 0.000281551183f, -0.000557466527f,
};

// Replaces so many p in (0, 1), in turns: the processor computes others while it waits for one.
// Uniform floats are at least 2^-24 away from 0 and 1, so w is at most 15.3.
template <std::uint32_t count, class R>
RDDL_INLINE void replace_by_quantiles(R* numbers) {
    R q[count], minus_w[count], quantiles[count];
    for (std::uint32_t i = 0; i < count; ++i) {
        const R p = numbers[i];
        q[i] = p - 0.5f;
        // This is no logarithm of a subnormal number, but less than -16 there all the same.
        minus_w[i] = ln_of_normal(4.0f * p * (1.0f - p), R{127.0f});
    }
    const auto in_tail = [&](std::uint32_t i) RDDL_INLINE_LAMBDA { return minus_w[i] < -5.0f; };
    auto in_some_tail = in_tail(0);  // one of 300
    for (std::uint32_t i = 0; i < count; ++i) {
        in_some_tail = in_some_tail || in_tail(i);
        quantiles[i] = q[i] * polynomial(quantile_coefficients, -2.5f - minus_w[i]);
    }
    for (std::uint32_t i = 0; any(in_some_tail) && i < count; ++i) {
        if (count > 1 && !any(in_tail(i))) continue;
        const R root = sqrt(-minus_w[i]);
        const R tail = q[i] * polynomial(quantile_tail_coefficients, root - 3.0f);
        quantiles[i] = select(in_tail(i), tail, quantiles[i]);
        const auto far = minus_w[i] < -16.0f;
        if (any(far))
            quantiles[i] =
                select(far, to_float(normal_quantile(to_double(numbers[i]))), quantiles[i]);
    }
    for (std::uint32_t i = 0; i < count; ++i) numbers[i] = quantiles[i];
}

// So many registers are computed in turns, of `most`: there is room for five, and the last ones
// should not be alone.
constexpr std::uint32_t quantiles_in_turns(std::uint32_t most) {
    constexpr std::uint32_t room = 5;
    const std::uint32_t groups = (most + room - 1) / room;
    return (most + groups - 1) / groups;
}

}  // namespace detail::single

// p in (0, 1).
template <FloatLanes R>
R normal_quantile(R p) {
    detail::single::replace_by_quantiles<1>(&p);
    return p;
}

// Replaces packs of p in (0, 1), `most` at most.
template <std::uint32_t most, int n>
[[gnu::noinline]] void replace_by_normal_quantiles(Lanes<float, n>* packs, std::uint32_t count) {
    constexpr bool are_registers = Lanes<float, n>::part_count == 1;
    constexpr std::uint32_t in_turns =
        are_registers ? detail::single::quantiles_in_turns(most) : 1;
    std::uint32_t i = 0;
    for (; i + in_turns <= count; i += in_turns)
        detail::single::replace_by_quantiles<in_turns>(packs + i);
    for (; i < count; ++i) packs[i] = normal_quantile(packs[i]);
}

}  // namespace rddl
