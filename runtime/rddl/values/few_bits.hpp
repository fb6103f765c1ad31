// Tests and counts of few bits of a row of bools, which the elements of a constant table choose. In
// packs, such bits are masks: to join these to ints takes longer than to look at few.
#pragma once

#include <rddl/lanes/pack.hpp>
#include <rddl/values/bits.hpp>
#include <rddl/values/narrow_bits.hpp>
#include <rddl/values/ops.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace rddl {

#ifdef RDDL_SIMD_SQUARES

namespace detail {

// The table of what `make` makes of each element.
template <class Make>
constexpr auto mapped(std::int64_t element, Make make) {
    return make(static_cast<std::uint64_t>(element));
}
template <std::size_t n, class T, class Make>
constexpr auto mapped(const std::array<T, n>& table, Make make) {
    std::array<decltype(mapped(table[0], make)), n> all{};
    for (std::size_t i = 0; i < n; ++i) all[i] = mapped(table[i], make);
    return all;
}

// The most ones that an element has, and the fewest.
struct OnesOfElements {
    int most, fewest;
};
constexpr OnesOfElements ones_of_elements(std::int64_t bits) {
    const int ones = std::popcount(static_cast<std::uint64_t>(bits));
    return {ones, ones};
}
template <std::size_t n, class T>
constexpr OnesOfElements ones_of_elements(const std::array<T, n>& table) {
    OnesOfElements all = ones_of_elements(table[0]);
    for (const T& part : table) {
        const OnesOfElements ones = ones_of_elements(part);
        all = {std::max(all.most, ones.most), std::min(all.fewest, ones.fewest)};
    }
    return all;
}

// The place of the one that k others are below, for each element of a table; 0 if it has
// fewer ones.
template <const auto& table, int k>
inline constexpr auto places_of_ones = mapped(table, [](std::uint64_t bits) {
    for (int below = 0; below < k; ++below) bits &= bits - 1;
    return static_cast<std::uint8_t>(bits == 0 ? 0 : std::countr_zero(bits));
});
// Whether there is such a one, as a mask.
template <const auto& table, int k>
inline constexpr auto have_ones = mapped(table, [](std::uint64_t bits) {
    return static_cast<std::uint16_t>(std::popcount(bits) > k ? 0xffff : 0);
});

// The bit at the place of the one that k others are below, of an element of the table.
template <const auto& table, int k, class Masks, class... Row>
RDDL_INLINE Mask<16> mask_at(const Masks& masks, const Row&... row) {
    const Mask<16> mask = masks(at(places_of_ones<table, k>, row...));
    if constexpr (k < ones_of_elements(table).fewest) return mask;
    return mask && Mask<16>::of_bits(at(have_ones<table, k>, row...));
}
// Calls visit(mask) for the bits at the places of all its ones.
template <const auto& table, class Visit, class Masks, class... Row>
RDDL_INLINE void for_each_mask(const Visit& visit, const Masks& masks, const Row&... row) {
    [&]<int... k>(std::integer_sequence<int, k...>) RDDL_INLINE_LAMBDA {
        (visit(mask_at<table, k>(masks, row...)), ...);
    }
    (std::make_integer_sequence<int, ones_of_elements(table).most>());
}

// How many of at most seven masks hold, as the digits of a binary number.
constexpr int most_ones_of_masks = 7;
struct OnesOfMasks {
    Mask<16> one{false}, two{false}, four{false};
};
RDDL_INLINE void add(OnesOfMasks& ones, Mask<16> mask) {
    const Mask<16> to_two = ones.one && mask, to_four = ones.two && to_two;
    ones = {ones.one != mask, ones.two != to_two, ones.four || to_four};
}
RDDL_INLINE Mask<16> operator==(const OnesOfMasks& ones, std::int64_t count) {
    if (count < 0 || count > most_ones_of_masks) return {false};
    return ones.one == mask_of_bit(count, 0) && ones.two == mask_of_bit(count, 1) &&
           ones.four == mask_of_bit(count, 2);
}
RDDL_INLINE Mask<16> operator!=(const OnesOfMasks& ones, std::int64_t count) {
    return !(ones == count);
}

}  // namespace detail

#endif

// Whether one at least of the ones of an element of the table is also one of the bits.
template <const auto& table, class Bits, class... Row>
RDDL_INLINE auto has_any_of(const Bits& bits, const Row&... row) {
    return bit_and(bits, at(table, row...)) != 0;
}
// How many of them are, to be compared with an int.
template <const auto& table, class Bits, class... Row>
RDDL_INLINE auto count_of(const Bits& bits, const Row&... row) {
    return count_ones(bit_and(bits, at(table, row...)));
}

#ifdef RDDL_SIMD_SQUARES

template <const auto& table, class T, class Masks, class... Row>
RDDL_INLINE Mask<16> has_any_of(const detail::NarrowBits<T, Masks>& bits, const Row&... row) {
    Mask<16> any{false};
    detail::for_each_mask<table>([&](Mask<16> mask) RDDL_INLINE_LAMBDA { any = any || mask; },
                                 bits.masks, row...);
    return any;
}
template <const auto& table, class T, class Masks, class... Row>
RDDL_INLINE auto count_of(const detail::NarrowBits<T, Masks>& bits, const Row&... row) {
    static_assert(detail::ones_of_elements(table).most <= detail::most_ones_of_masks);
    detail::OnesOfMasks ones;
    detail::for_each_mask<table>([&](Mask<16> mask) RDDL_INLINE_LAMBDA { add(ones, mask); },
                                 bits.masks, row...);
    return ones;
}

#endif

}  // namespace rddl
