// The interface of a real type for the elementary functions (rddl/values/math.hpp), here for double
// and float.
//
// A pack of reals, one in each lane, offers the same names with the same meaning in every lane:
//
//     + - * / and unary -           also with a double on one side
//     == != < <= > >=               give a mask (for double: bool), which has && || !
//     any(mask)                     whether it holds in some lane
//     select(mask, a, b)            a where it holds, else b
//     absolute, sqrt                exact, and rounded exactly
//     bits_of, real_of_bits         IEEE's binary64 as an unsigned integer of 64 bits that wraps
//                                   around and has + - & | ^, also with std::uint64_t on the right,
//                                   and << >> by an int
//     first_if_even(bits, x, y)     x where the last bit is 0, else y, without a jump
//     map_lanes(x, f), (x, y, f)    f, a function of doubles, in each lane
//     replace_lanes(mask, x, r, f)  f(x) in the lanes of the mask, which are few, else r
//
// float and packs of it have the same with binary32, std::uint32_t and floats, and
//
//     to_double, to_float           between both, lane by lane
//     lower_halves                  the last 32 bits of unsigned integers of 64 bits
#pragma once

#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <type_traits>

#ifdef __FAST_MATH__
#error "rddl needs IEEE arithmetic: compile without -ffast-math"
#endif

// Inlines functions that are small, or constant in most calls, when lanes are packs: passing packs
// costs more.
#define RDDL_ALWAYS_INLINE __attribute__((always_inline)) inline

namespace rddl {

constexpr std::uint64_t bits_of(double a) {
    return std::bit_cast<std::uint64_t>(a);
}
constexpr double real_of_bits(std::uint64_t bits) {
    return std::bit_cast<double>(bits);
}

constexpr std::uint32_t bits_of(float a) {
    return std::bit_cast<std::uint32_t>(a);
}
constexpr float real_of_bits(std::uint32_t bits) {
    return std::bit_cast<float>(bits);
}
constexpr double to_double(float a) {
    return a;
}
constexpr float to_float(double a) {
    return static_cast<float>(a);
}
constexpr std::uint32_t lower_halves(std::uint64_t bits) {
    return static_cast<std::uint32_t>(bits);
}

// The same number, which the C++ compiler does not know: functions of numbers that it knows are
// computed by it, exactly, and not as the mathematical library does.
template <std::floating_point R>
R unknown(R a) {
#ifdef __SSE2__
    asm("" : "+x"(a));
#else
    asm("" : "+m"(a));
#endif
    return a;
}

// double or a pack of doubles, but no integer that would become one; the same with float.
template <class R>
concept RealLanes = std::same_as<R, double> || std::same_as<typename R::Element, double>;
template <class R>
concept FloatLanes = std::same_as<R, float> || std::same_as<typename R::Element, float>;

constexpr bool any(bool mask) {
    return mask;
}
constexpr double select(bool condition, double a, double b) {
    return condition ? a : b;
}
constexpr float select(bool condition, float a, float b) {
    return condition ? a : b;
}

inline double absolute(double a) {
    return std::fabs(a);
}
inline float absolute(float a) {
    return std::fabs(a);
}
inline double sqrt(double a) {
    return std::sqrt(a);
}
inline float sqrt(float a) {
    return std::sqrt(a);
}

template <std::floating_point R>
R first_if_even(decltype(bits_of(R{})) bits, R first, R second) {
    const auto odd = decltype(bits){0} - (bits & 1);
    return real_of_bits(bits_of(first) ^ ((bits_of(first) ^ bits_of(second)) & odd));
}

template <class Function>
double map_lanes(double a, Function function) {
    return function(a);
}
template <class Function>
double map_lanes(double a, double b, Function function) {
    return function(a, b);
}
template <class Function>
double replace_lanes(bool replaced, double a, double others, Function function) {
    return replaced ? function(a) : others;
}

}  // namespace rddl
