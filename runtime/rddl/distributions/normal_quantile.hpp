// The inverse of the standard normal distribution function.
// M. Wichura, Algorithm AS 241 (PPND16), Applied Statistics 37 (1988), 477-484; relative error
// about 1e-16.
#pragma once

#include <rddl/math.hpp>
#include <rddl/real.hpp>

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

// For r = sqrt(-ln(tail probability)) up to 5, and beyond.
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
    const R r = sqrt(-ln(select(q < 0.0, p, 1.0 - p)));
    const auto far = r > 5.0;  // once in 4e10 draws
    Fraction<R> tail = normal_quantile_tail(r);
    if (any(far)) tail = select_fraction(far, normal_quantile_far_tail(r), tail);
    return {with_sign_of(q, tail.dividend), tail.divisor};
}

}  // namespace detail

// p in (0, 1).
template <RealLanes R>
R normal_quantile(R p) {
    const R q = p - 0.5;
    const auto central = absolute(q) <= 0.425;
    detail::Fraction<R> result = detail::normal_quantile_centre(q);
    if (any(!central))
        result = select_fraction(central, result, detail::normal_quantile_outside(p, q));
    return result.dividend / result.divisor;
}

}  // namespace rddl
