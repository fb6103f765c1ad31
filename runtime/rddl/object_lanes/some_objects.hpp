// Neighbouring objects, and their elements of a table in vector registers.
#pragma once

#include <rddl/lanes/simd.hpp>
#include <rddl/lanes/simd_bytes.hpp>
#include <rddl/lanes/simd_moves.hpp>
#include <rddl/values/pack_ops.hpp>

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace rddl {

// Named after the level of simd.hpp, as packs are.
inline namespace RDDL_SIMD_LEVEL {

// The objects [first, first + count), up to n of them.
template <int n>
struct SomeObjects {
    Index first;
    int count;
    constexpr operator Index() const { return first; }

    Mask<n> mask() const { return Mask<n>::of_bits(~std::uint64_t{0} >> (64 - count)); }
};

}  // namespace RDDL_SIMD_LEVEL

namespace detail {

// The part of nested arrays that leading indices choose.
template <class T>
constexpr const T& row_of(const T& table) {
    return table;
}
template <class T, class... Rest>
constexpr const auto& row_of(const T& table, Index first, const Rest&... rest) {
    return row_of(table[static_cast<std::size_t>(first)], rest...);
}

template <int n>
RDDL_INLINE Mask<n> load_some(const bool* from, const SomeObjects<n>& objects) {
    return Mask<n>::of_bits(simd::bits_of_stored_bytes(from, objects.count));
}
template <int n, class T>
RDDL_INLINE Lanes<T, n> load_some(const T* from, const SomeObjects<n>& objects) {
    if (objects.count == n) return Lanes<T, n>::load(from);
    Lanes<T, n> values;
    const int count = objects.count;
    if constexpr (Lanes<T, n>::is_half) {
        values.part[0] = __builtin_constant_p(count) && count > 1 && count <= simd::most_in_pairs
                             ? simd::load_one_by_one(from, count)
                             : simd::load_some_of_half(from, count);
        return values;
    } else if constexpr (std::is_same_v<T, double> && values.part_count == 1) {
        values.part[0] = __builtin_constant_p(count) && count > 1 && count <= simd::most_in_pairs
                             ? simd::load_in_pairs(from, count)
                             : simd::load_some(from, count);
        return values;
    } else {
        for (int p = 0, first = 0; p < values.part_count; ++p, first += values.part_width)
            values.part[p] = simd::load_some(from + first, count - first);
        return values;
    }
}
template <int n>
RDDL_INLINE void store_some(bool* to, const SomeObjects<n>& objects, const Mask<n>& values) {
    simd::store_as_bytes<n>(values.bits, to, objects.count);
}
template <int n, class T>
RDDL_INLINE void store_some(T* to, const SomeObjects<n>& objects, const Lanes<T, n>& values) {
    if (objects.count == n) return values.store(to);
    if constexpr ((std::is_same_v<T, double> && Lanes<T, n>::part_count == 1) ||
                  Lanes<T, n>::is_half) {
        const int count = objects.count;
        if (__builtin_constant_p(count) && count <= simd::most_in_pairs)
            return simd::store_one_by_one(to, values.part[0], count);
    }
    if constexpr (Lanes<T, n>::is_half)
        simd::store_some_of_half(to, values.part[0], objects.count);
    else
        for (int p = 0, first = 0; p < values.part_count; ++p, first += values.part_width)
            simd::store_some(to + first, values.part[p], objects.count - first);
}

}  // namespace detail

}  // namespace rddl
