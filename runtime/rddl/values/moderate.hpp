// Moderate numbers: products of four of them, and sums of those, are finite, in floats as well. For
// them `0 * x` is 0, so a step of moderate values may leave out terms that another step must add.
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/lanes/pack.hpp>
#include <rddl/values/ops.hpp>
#include <rddl/values/pack_ops.hpp>

#include <array>
#include <cstddef>
#include <type_traits>

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
// The bits of the magnitude: they grow with it, and those of nan are the greatest.
template <class Real>
RDDL_INLINE auto magnitude(const Real& value) {
    return rddl::bits_of(absolute(value));
}
// The bits of the greatest magnitude of so many values, in chains that do not wait for each other.
// A value may be looked at twice.
template <std::size_t chains, std::size_t count, class At>
RDDL_INLINE auto greatest_magnitude(const At& at) {
    std::array<decltype(magnitude(at(0))), chains> greatest;
    for (std::size_t k = 0; k < chains; ++k) greatest[k] = magnitude(at(k));
    const auto look_at = [&](std::size_t first) RDDL_INLINE_LAMBDA {
        for (std::size_t k = 0; k < chains; ++k)
            greatest[k] = greater(greatest[k], magnitude(at(first + k)));
    };
    for (std::size_t first = chains; first + chains <= count; first += chains) look_at(first);
    if constexpr (count % chains != 0) look_at(count - chains);
    for (std::size_t k = 1; k < chains; ++k) greatest[0] = greater(greatest[0], greatest[k]);
    return greatest[0];
}
template <std::size_t chains, std::size_t count, class At>
RDDL_INLINE auto are_all_moderate(const At& at) {
    using Real = std::remove_cvref_t<decltype(at(0))>;
    return real_of_bits(greatest_magnitude<chains, count>(at)) <= Real(moderate);
}

}  // namespace detail

// Whether a real of a record is moderate, or all elements of a table are; nan is not. One
// environment takes registers of a table at once, the last ones with elements of those before.
template <class L, class Table>
typename L::Bool is_moderate(const Table& table) {
    using Real = typename L::Real;
    constexpr std::size_t count = sizeof(Table) / sizeof(Real);
    const auto* const elements = reinterpret_cast<const Real*>(&table);
    if constexpr (L::width == 1) {
        constexpr std::size_t width = simd::lanes_of<Real> < 8 ? 8 : simd::lanes_of<Real>;
        if constexpr (count >= width) {
            constexpr std::size_t registers = (count + width - 1) / width;
            constexpr std::size_t chains = registers < 4 ? registers : 4;
            const auto load = [=](std::size_t i) RDDL_INLINE_LAMBDA {
                const std::size_t first = i + 1 < registers ? i * width : count - width;
                return Lanes<Real, static_cast<int>(width)>::load(elements + first);
            };
            return all(detail::are_all_moderate<chains, registers>(load));
        }
    }
    return detail::are_all_moderate<1, count>([=](std::size_t i)
                                                  RDDL_INLINE_LAMBDA { return elements[i]; });
}

}  // namespace rddl
