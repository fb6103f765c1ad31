// What a real type offers to the elementary functions (rddl/math.hpp), here for double.
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
//     map_lanes(x, f), (x, y, f)    f, a function of doubles, in each lane
#pragma once

#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <type_traits>

#ifdef __FAST_MATH__
#error "rddl needs IEEE arithmetic: compile without -ffast-math"
#endif

// For what is small, or constant in most calls, when lanes are packs: passing packs costs more.
#define RDDL_ALWAYS_INLINE __attribute__((always_inline)) inline

namespace rddl {

constexpr std::uint64_t bits_of(double a) {
    return std::bit_cast<std::uint64_t>(a);
}
constexpr double real_of_bits(std::uint64_t bits) {
    return std::bit_cast<double>(bits);
}

// double or a pack, but no integer that would become a double.
template <class R>
concept RealLanes = (std::same_as<R, double> || std::is_class_v<R>)&&requires(R a) {
    bits_of(a);
};

constexpr bool any(bool mask) {
    return mask;
}
constexpr double select(bool condition, double a, double b) {
    return condition ? a : b;
}

inline double absolute(double a) {
    return std::fabs(a);
}
inline double sqrt(double a) {
    return std::sqrt(a);
}

template <class Function>
double map_lanes(double a, Function function) {
    return function(a);
}
template <class Function>
double map_lanes(double a, double b, Function function) {
    return function(a, b);
}

}  // namespace rddl
