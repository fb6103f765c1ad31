// Moderate numbers: products of four of them, and sums of those, are finite, in floats as well. For
// them `0 * x` is 0, so a step of moderate values may leave out terms that another step must add.
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/lanes/pack.hpp>
#include <rddl/values/ops.hpp>
#include <rddl/values/pack_ops.hpp>

#include <array>
#include <cstddef>

namespace rddl {

// The greatest magnitude of a moderate number.
inline constexpr double moderate = 0x1p30;

namespace detail {

template <class Bits>
RDDL_INLINE Bits greater(const Bits& a, const Bits& b) {
    if constexpr (SomePack<Bits>)
        return Bits::each([](auto x, auto y) RDDL_INLINE_LAMBDA { return x < y ? y : x; }, a, b);
    else
        return a < b ? b : a;
}
// The bits of the greatest magnitude: bits grow with magnitudes, and those of nan are the greatest.
template <class Real>
RDDL_INLINE auto greatest_magnitude(const Real& value) {
    return rddl::bits_of(absolute(value));
}
template <class Element, std::size_t n>
RDDL_INLINE auto greatest_magnitude(const std::array<Element, n>& table) {
    auto greatest = greatest_magnitude(table[0]);
    for (std::size_t i = 1; i < n; ++i) greatest = greater(greatest, greatest_magnitude(table[i]));
    return greatest;
}

}  // namespace detail

// Whether a real of a record is moderate, or all elements of a table are; nan is not.
template <class L, class Table>
typename L::Bool is_moderate(const Table& table) {
    return real_of_bits(detail::greatest_magnitude(table)) <= typename L::Real(moderate);
}

}  // namespace rddl
