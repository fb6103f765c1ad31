// Sines and cosines of several angles.
//
// One environment has the angles in the lanes of registers; packs of environments compute one after
// the other. Each has the same bits as if it were computed alone.
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/lanes/pack.hpp>
#include <rddl/lanes/simd.hpp>
#include <rddl/values/math/single.hpp>
#include <rddl/values/math/trigonometric.hpp>
#include <rddl/values/pack_ops.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace rddl {

template <class Real>
struct SineOf {
    static constexpr bool is_sine = true;
    Real angle;
};
template <class Real>
struct CosineOf {
    static constexpr bool is_sine = false;
    Real angle;
};
template <class Real>
RDDL_INLINE SineOf<Real> sine_of(const Real& angle) {
    return {angle};
}
template <class Real>
RDDL_INLINE CosineOf<Real> cosine_of(const Real& angle) {
    return {angle};
}

namespace detail {

template <class Real>
RDDL_INLINE Real value_of(const SineOf<Real>& function) {
    return sin(function.angle);
}
template <class Real>
RDDL_INLINE Real value_of(const CosineOf<Real>& function) {
    return cos(function.angle);
}

// Lane by lane, since registers are slow to load what has just been stored in parts.
template <class R, std::size_t n>
RDDL_INLINE auto lanes_of_values(const std::array<R, n>& values) {
    Lanes<R, static_cast<int>(n)> lanes;
    const auto part = [&]<std::size_t... lane>(std::size_t first, std::index_sequence<lane...>)
        RDDL_INLINE_LAMBDA {
        return typename Lanes<R, static_cast<int>(n)>::Vector{values[first + lane]...};
    };
    constexpr auto width = static_cast<std::size_t>(lanes.part_width);
    for (std::size_t p = 0; p < n / width; ++p)
        lanes.part[p] = part(p * width, std::make_index_sequence<width>());
    return lanes;
}

// The sine, in lanes of the mask, or the cosine, which is the sine a quarter turn further on.
template <int n>
RDDL_INLINE Lanes<double, n> sines_and_cosines(const Lanes<double, n>& a, Mask<n> is_sine) {
    using Word = Lanes<std::uint64_t, n>;
    const auto [quadrants, rest] = angle(a);
    const auto s = sine(rest);
    const auto c = cosine(rest);
    const Word turns = quadrants + select(is_sine, Word{std::uint64_t{0}}, Word{std::uint64_t{1}});
    const auto magnitude = first_if_even(turns, s.high + s.low, c.high + c.low);
    const auto result = negated_by_bit(turns, 1, magnitude);
    return select(is_sine && absolute(a) < 0x1p-27, a, result);
}

template <int n>
RDDL_INLINE Lanes<float, n> sines_and_cosines(const Lanes<float, n>& a, Mask<n> is_sine) {
    using Word = Lanes<std::uint32_t, n>;
    const Word quarters = bits_of(select(is_sine, 0.0f, real_of_bits(std::uint32_t{1})));
    const auto result = single::sine(single::near_circle(a), quarters);
    return select(is_sine && absolute(a) < 0x1p-12f, a, result);
}

template <class R>
inline constexpr R greatest_in_lanes =
    std::is_same_v<R, float> ? R{single::greatest_near_angle} : R{greatest_angle};

template <class Real, std::size_t count, class... Functions>
RDDL_INLINE void evaluate_one_by_one(std::array<Real, count>& values,
                                     const Functions&... functions) {
    std::size_t k = 0;
    ((values[k++] = value_of(functions)), ...);
}

}  // namespace detail

// Fills the vector with the values of the functions.
template <class Real, std::size_t count, class... Functions>
RDDL_INLINE void evaluate_together(std::array<Real, count>& values, const Functions&... functions) {
    detail::evaluate_one_by_one(values, functions...);
}
template <std::floating_point R, std::size_t count, class... Functions>
RDDL_INLINE void evaluate_together(std::array<R, count>& values, const Functions&... functions) {
    static_assert(count <= 16);
    constexpr int n = count <= 8 ? 8 : 16;
    constexpr std::uint64_t sines = [] {
        std::uint64_t bits = 0;
        int k = 0;
        ((bits |= std::uint64_t{Functions::is_sine} << k++), ...);
        return bits;
    }();
    const auto angles = detail::lanes_of_values(std::array<R, n>{functions.angle...});
    if (any(absolute(angles) > detail::greatest_in_lanes<R>)) [[unlikely]]
        return detail::evaluate_one_by_one(values, functions...);
    const auto results = detail::sines_and_cosines(angles, Mask<n>::of_bits(sines));
    std::array<R, n> all;
    results.store(all.data());
    for (std::size_t k = 0; k < count; ++k) values[k] = all[k];
}

}  // namespace rddl
