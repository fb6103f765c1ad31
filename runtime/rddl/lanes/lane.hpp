// Lane types: what one evaluation of the emitted code works on.
//
// Emitted code and kernels are generic over a lane type L, which names the types of values. Scalar
// is one environment, Pack<n> (pack.hpp) is n of them. Both hold reals as double; ScalarOf<float>
// and Pack<n, float> hold them as float.
#pragma once

#include <rddl/lanes/simd.hpp>

#include <cstdint>
#include <type_traits>

namespace rddl {

// Named after the level of simd.hpp as packs are, since Context<Scalar> depends on it.
inline namespace RDDL_SIMD_LEVEL {

template <class R>
struct ScalarOf {
    static constexpr int width = 1;
    using Element = R;  // the real of one lane
    using Bool = bool;
    using Int = std::int64_t;
    using Real = R;
    using Count = std::int64_t;  // of steps or episodes
    using Word = std::uint64_t;  // 64 random bits, or a counter
};
using Scalar = ScalarOf<double>;

}  // namespace RDDL_SIMD_LEVEL

// A loop index: the same in every lane.
using Index = std::int64_t;

// The value of one lane, and another one in its place.
template <class T>
constexpr auto get_lane(const T& value, int lane) {
    return value[lane];
}
template <class T, class Value>
constexpr void set_lane(T& target, int lane, Value value) {
    target.set(lane, value);
}
template <class T>
requires std::is_arithmetic_v<T>
constexpr T get_lane(const T& value, int) {
    return value;
}
template <class T, class Value>
requires std::is_arithmetic_v<T>
constexpr void set_lane(T& target, int, Value value) {
    target = value;
}

}  // namespace rddl
