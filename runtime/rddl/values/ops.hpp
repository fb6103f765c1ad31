// RDDL's scalar operators that C++ lacks or defines differently.
//
// int is int64 and wraps around; real is IEEE double, or float. Every operation here is defined for
// all operands. Real + - * / and comparisons, and the connectives on bool, are the plain C++
// operators.
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/lanes/real.hpp>
#include <rddl/values/context.hpp>
#include <rddl/values/math.hpp>

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace rddl {

// ------------------------------------------------------------------------------ choices

// Both values are evaluated by the caller.
constexpr bool select(bool condition, bool a, bool b) {
    return condition ? a : b;
}
constexpr std::int64_t select(bool condition, std::int64_t a, std::int64_t b) {
    return condition ? a : b;
}

// Evaluates only the branch taken; the branches are functions without parameters.
template <class R, class Then, class Else>
constexpr auto branch(Context<ScalarOf<R>>&, bool condition, Then&& then_value, Else&& else_value) {
    return condition ? then_value() : else_value();
}
// Selects between branches that neither draw nor fault: packs evaluate both, without a jump.
template <class Then, class Else>
requires std::invocable<Then>
constexpr auto branch(bool condition, Then&& then_value, Else&& else_value) {
    return condition ? then_value() : else_value();
}
// "if condition then ... else if next() then ... else ...": further conditions are functions too.
template <class L, class Bool, class Then, class Next, class... Rest>
requires(sizeof...(Rest) >= 2) constexpr auto branch(Context<L>& context, Bool condition,
                                                     Then&& then_value, Next&& next,
                                                     Rest&&... rest) {
    return branch(context, condition, then_value, [&] { return branch(context, next(), rest...); });
}

template <class Bool, class Then, class Next, class... Rest>
requires std::invocable<Then> &&(sizeof...(Rest) >= 2)  //
    constexpr auto branch(Bool condition, Then&& then_value, Next&& next, Rest&&... rest) {
    return branch(condition, then_value, [&] { return branch(next(), rest...); });
}

// ---------------------------------------------------------------------------- conversions

constexpr std::int64_t to_int(bool a) {
    return a ? 1 : 0;
}
// As an int of this type: packs may have others (pack_ops.hpp).
template <class Int>
constexpr Int to_int(bool a) {
    return a ? 1 : 0;
}
constexpr double to_real(bool a) {
    return a ? 1.0 : 0.0;
}
constexpr double to_real(std::int64_t a) {
    return static_cast<double>(a);
}
constexpr float to_float(bool a) {
    return a ? 1.0f : 0.0f;
}
constexpr float to_float(std::int64_t a) {
    return static_cast<float>(a);
}

// Truncates; nan and what int cannot hold give the least int, as the conversion of x86 does.
constexpr std::int64_t truncate_to_int(double a) {
#if defined(__SSE2__) && defined(__x86_64__)
    // g++ takes the greatest int for a number too great that it knows, not what the processor
    // gives.
    if (!std::is_constant_evaluated()) return _mm_cvttsd_si64(_mm_set_sd(unknown(a)));
#endif
    constexpr double limit = 0x1p63;
    return a >= -limit && a < limit ? static_cast<std::int64_t>(a)
                                    : std::numeric_limits<std::int64_t>::min();
}
constexpr std::int64_t truncate_to_int(float a) {
#if defined(__SSE2__) && defined(__x86_64__)
    if (!std::is_constant_evaluated()) return _mm_cvttss_si64(_mm_set_ss(unknown(a)));
#endif
    return truncate_to_int(to_double(a));
}

// ------------------------------------------------------------------------- int arithmetic

constexpr std::int64_t wrap_add(std::int64_t a, std::int64_t b) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}
constexpr std::int64_t wrap_sub(std::int64_t a, std::int64_t b) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b));
}
constexpr std::int64_t wrap_mul(std::int64_t a, std::int64_t b) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) * static_cast<std::uint64_t>(b));
}
constexpr std::int64_t wrap_neg(std::int64_t a) {
    return wrap_sub(0, a);
}

// Rounds toward -inf; by 0 gives 0.
constexpr std::int64_t floor_div(std::int64_t a, std::int64_t b) {
    if (b == 0) return 0;
    if (b == -1) return wrap_neg(a);
    const bool rounds_up = a % b != 0 && (a < 0) != (b < 0);
    return a / b - (rounds_up ? 1 : 0);
}

// Has the sign of the divisor; by 0 gives 0.
constexpr std::int64_t floor_mod(std::int64_t a, std::int64_t b) {
    if (b == 0 || b == -1) return 0;
    const std::int64_t remainder = a % b;
    return remainder != 0 && (remainder < 0) != (b < 0) ? remainder + b : remainder;
}

constexpr std::int64_t wrap_power(std::int64_t base, std::int64_t exponent) {
    std::int64_t result = 1;
    for (; exponent > 0; exponent >>= 1) {
        if (exponent & 1) result = wrap_mul(result, base);
        base = wrap_mul(base, base);
    }
    return result;
}

// Faults on a negative exponent.
template <class R>
constexpr std::int64_t power(Context<ScalarOf<R>>& context, Place place, std::int64_t base,
                             std::int64_t exponent) {
    const bool valid =
        context.require(exponent >= 0, FaultKind::NegativeExponent, place, to_real(exponent));
    return valid ? wrap_power(base, exponent) : 0;
}

// ------------------------------------------------------------------- ints and reals alike

template <class T>
requires std::is_arithmetic_v<T>
constexpr bool is_nan(T a) {
    return a != a;
}

// All others are equal to nothing but themselves.
template <std::floating_point R>
constexpr bool is_zero_or_nan(R a) {
    return !(a < 0 || a > 0);
}

constexpr std::int64_t absolute(std::int64_t a) {
    return a < 0 ? wrap_neg(a) : a;
}

constexpr std::int64_t sign(std::int64_t a) {
    return to_int(a > 0) - to_int(a < 0);
}
constexpr std::int64_t sign(double a) {
    return is_nan(a) ? std::numeric_limits<std::int64_t>::min() : to_int(a > 0) - to_int(a < 0);
}

constexpr std::int64_t minimum(std::int64_t a, std::int64_t b) {
    return b < a ? b : a;
}
constexpr std::int64_t maximum(std::int64_t a, std::int64_t b) {
    return a < b ? b : a;
}
// nan wins, and of equal numbers the first. With a constant that takes one instruction.
template <std::floating_point R>
constexpr R minimum(R a, R b) {
    if (__builtin_constant_p(a) && !is_zero_or_nan(a)) return a < b ? a : b;
#ifdef __clang__
    // clang 14 gives -0.0 for 0.0 and the constant -0.0 if this is written as below.
    return a <= b || is_nan(a) ? a : b;
#else
    return b < a || is_nan(b) ? b : a;
#endif
}
template <std::floating_point R>
constexpr R maximum(R a, R b) {
    if (__builtin_constant_p(a) && !is_zero_or_nan(a)) return a > b ? a : b;
    return b > a || is_nan(b) ? b : a;
}

// -------------------------------------------------- real functions beside those of math.hpp

namespace detail {

// to_real(truncate_to_int(a)) of a whole number, nan or infinity. No int gives -0.0.
template <std::floating_point R>
R whole_as_real(R a) {
    return absolute(a) < R{0x1p63} ? a + R{0} : R{-0x1p63};
}

}  // namespace detail

// To int; halves go to the even neighbour.
template <std::floating_point R>
std::int64_t round(R a) {
    return truncate_to_int(std::nearbyint(a));
}
template <std::floating_point R>
std::int64_t floor(R a) {
    return truncate_to_int(std::floor(a));
}
template <std::floating_point R>
std::int64_t ceil(R a) {
    return truncate_to_int(std::ceil(a));
}

// to_real of the three, faster for one real.
template <std::floating_point R>
R round_as_real(R a) {
    return detail::whole_as_real(std::nearbyint(a));
}
template <std::floating_point R>
R floor_as_real(R a) {
    return detail::whole_as_real(std::floor(a));
}
template <std::floating_point R>
R ceil_as_real(R a) {
    return detail::whole_as_real(std::ceil(a));
}

inline double ln_absolute_gamma(double a) {
    int sign_of_gamma;
    return ::lgamma_r(unknown(a), &sign_of_gamma);  // std::lgamma writes a global variable
}
inline double gamma_of(double a) {
    return std::tgamma(unknown(a));
}
// Both fault unless a > 0.
template <class R>
R ln_gamma(Context<ScalarOf<R>>& context, Place place, std::type_identity_t<R> a) {
    const bool valid = context.require(a > 0, FaultKind::GammaArgument, place, a);
    return valid ? static_cast<R>(ln_absolute_gamma(a)) : R{0};
}
template <class R>
R gamma(Context<ScalarOf<R>>& context, Place place, std::type_identity_t<R> a) {
    const bool valid = context.require(a > 0, FaultKind::GammaArgument, place, a);
    return valid ? static_cast<R>(gamma_of(a)) : R{0};
}

// -------------------------------------------------------------------------------- indexing

// An element of a nested std::array. The indices are in range by construction.
template <class Array>
constexpr auto at(const Array& array, std::int64_t index) {
    return array[static_cast<std::size_t>(index)];
}
template <class Array, class... Indices>
constexpr auto at(const Array& array, std::int64_t index, Indices... rest) {
    return at(array[static_cast<std::size_t>(index)], rest...);
}

}  // namespace rddl
