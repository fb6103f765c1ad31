// Quotients, remainders and angles that cost less than the functions of simulators.
#pragma once

#include <rddl/simulator.hpp>

#include <type_traits>

namespace least_steps {

// ---------------------------------------------------------------------------------- fractions

#ifdef RDDL_SIMD_AVX512

RDDL_ALWAYS_INLINE __m512d fused(__m512d a, __m512d b, __m512d c) {
    return _mm512_fmadd_pd(a, b, c);
}
RDDL_ALWAYS_INLINE __m512 fused(__m512 a, __m512 b, __m512 c) {
    return _mm512_fmadd_ps(a, b, c);
}

// The quotient by a constant: a product with the reciprocal that is corrected by what is left. It
// has the same bits as the division where nothing overflows or underflows.
template <class T, int n>
RDDL_INLINE rddl::Lanes<T, n> over(const rddl::Lanes<T, n>& a, double constant) {
    using Real = rddl::Lanes<T, n>;
    const T divisor = static_cast<T>(constant);
    const Real reciprocal = T{1} / divisor, negated = -divisor;
    const Real product = a * reciprocal;
    return Real::each(
        [](auto dividend, auto quotient, auto minus, auto factor) RDDL_INLINE_LAMBDA {
            const auto rest = fused(quotient, minus, dividend);
            return decltype(dividend)(fused(rest, factor, quotient));
        },
        a, product, negated, reciprocal);
}

// The remainder in [0, constant), rounded once, where the quotient is not great.
template <class T, int n>
RDDL_INLINE rddl::Lanes<T, n> modulo(const rddl::Lanes<T, n>& a, double constant) {
    using Real = rddl::Lanes<T, n>;
    const T divisor = static_cast<T>(constant);
    const Real rest = Real::each(
        [](auto dividend, auto quotient, auto minus)
            RDDL_INLINE_LAMBDA { return decltype(dividend)(fused(quotient, minus, dividend)); },
        a, rddl::floor_as_real(a * (T{1} / divisor)), Real{-divisor});
    const Real not_negative = rddl::select(rest < Real{0}, rest + divisor, rest);
    return rddl::select(not_negative >= Real{divisor}, not_negative - divisor, not_negative);
}

#else

template <class T, int n>
RDDL_INLINE rddl::Lanes<T, n> modulo(const rddl::Lanes<T, n>& a, double constant) {
    return rddl::floor_mod(a, rddl::Lanes<T, n>{constant});
}
template <class T, int n>
RDDL_INLINE rddl::Lanes<T, n> over(const rddl::Lanes<T, n>& a, double constant) {
    return a / static_cast<T>(constant);
}

#endif

// ------------------------------------------------------------------------------------- angles

template <class Real>
struct SinCos {
    Real sin, cos;
};

// Both with one reduction, for angles that are not too great for it.
template <int n>
RDDL_INLINE SinCos<rddl::Lanes<double, n>> sin_cos(const rddl::Lanes<double, n>& a) {
    using namespace rddl::detail;
    const auto [quadrants, rest] = angle(a);
    const auto s = sine(rest), c = cosine(rest);
    const auto sin = s.high + s.low, cos = c.high + c.low;
    const auto next = quadrants + std::uint64_t{1};
    return {negated_by_bit(quadrants, 1, first_if_even(quadrants, sin, cos)),
            negated_by_bit(next, 1, first_if_even(quadrants, cos, sin))};
}
template <int n>
RDDL_INLINE SinCos<rddl::Lanes<float, n>> sin_cos(const rddl::Lanes<float, n>& a) {
    using namespace rddl::detail::single;
    const auto parts = near_circle(a);
    return {sine(parts, std::uint32_t{0}), sine(parts, std::uint32_t{1})};
}

}  // namespace least_steps
