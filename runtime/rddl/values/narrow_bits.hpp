// Few bools as the bits of ints: in packs, the ints may have 16 or 32 bits.
#pragma once

#include <rddl/lanes/pack.hpp>
#include <rddl/lanes/simd.hpp>
#include <rddl/values/bits.hpp>
#include <rddl/values/narrow_width.hpp>

#include <cstdint>
#include <type_traits>

namespace rddl {

#ifdef RDDL_SIMD_SQUARES

namespace detail {

// A register of 16 lanes, each a T.
template <class T>
struct NarrowLanes {
    using Vector [[gnu::vector_size(16 * sizeof(T))]] = T;
};
template <class T>
using NarrowVector = typename NarrowLanes<T>::Vector;

// Bits of 16 environments, each a T. What they meet must fit into T, so that the results are those
// of 64 bits. `masks(i)` is where bit i is 1, of the masks that were joined.
template <class T, class Masks>
struct NarrowBits {
    NarrowVector<T> bits;
    Masks masks;
};
template <class T, class Masks>
RDDL_INLINE NarrowBits<T, Masks> narrow(const NarrowVector<T>& bits, const Masks& masks) {
    return {bits, masks};
}
// Bit i of an int, for all environments.
RDDL_INLINE Mask<16> mask_of_bit(std::int64_t bits, int i) {
    return Mask<16>((bits >> i & 1) != 0);
}

template <class T, class Masks>
RDDL_INLINE Lanes<std::int64_t, 16> wide(const NarrowBits<T, Masks>& narrow) {
    Lanes<std::int64_t, 16> result;
    if constexpr (sizeof(T) == 2) {
        const auto all = simd::reinterpret<__m256i>(narrow.bits);
        result.part[0] = simd::reinterpret<simd::Ints>(
            _mm512_maskz_cvtepi16_epi64(0xff, _mm256_castsi256_si128(all)));
        result.part[1] = simd::reinterpret<simd::Ints>(
            _mm512_maskz_cvtepi16_epi64(0xff, _mm256_extracti128_si256(all, 1)));
    } else {
        const auto all = simd::reinterpret<__m512i>(narrow.bits);
        result.part[0] = simd::reinterpret<simd::Ints>(
            _mm512_maskz_cvtepi32_epi64(0xff, _mm512_maskz_extracti64x4_epi64(0xff, all, 0)));
        result.part[1] = simd::reinterpret<simd::Ints>(
            _mm512_maskz_cvtepi32_epi64(0xff, _mm512_maskz_extracti64x4_epi64(0xff, all, 1)));
    }
    return result;
}

template <class T, class Masks>
RDDL_INLINE Mask<16> operator==(const NarrowBits<T, Masks>& a, std::int64_t b) {
    const NarrowVector<T> all = NarrowVector<T>{} + static_cast<T>(b);
    if constexpr (sizeof(T) == 2)
        return Mask<16>::of_bits(_mm256_cmpeq_epi16_mask(simd::reinterpret<__m256i>(a.bits),
                                                         simd::reinterpret<__m256i>(all)));
    else
        return Mask<16>::of_bits(_mm512_cmpeq_epi32_mask(simd::reinterpret<__m512i>(a.bits),
                                                         simd::reinterpret<__m512i>(all)));
}

template <class T, class Masks>
RDDL_INLINE Mask<16> operator!=(const NarrowBits<T, Masks>& a, std::int64_t b) {
    return !(a == b);
}

// As joined_in_lanes (rddl/values/bool_rows.hpp): few masks are joined one by one.
template <int count, class T>
RDDL_INLINE NarrowVector<T> joined_in_narrow_lanes(const Mask<16>* bools) {
    NarrowVector<T> joined{};
    for (int i = 0; i < count; ++i) {
        const auto bit = NarrowVector<T>{} + static_cast<T>(1 << i);
        if constexpr (sizeof(T) == 2)
            joined |= simd::reinterpret<NarrowVector<T>>(
                _mm256_maskz_mov_epi16(bools[i].bits, simd::reinterpret<__m256i>(bit)));
        else
            joined |= simd::reinterpret<NarrowVector<T>>(
                _mm512_maskz_mov_epi32(bools[i].bits, simd::reinterpret<__m512i>(bit)));
    }
    return joined;
}

template <int count, class T>
RDDL_INLINE NarrowVector<T> narrow_lanes_of(const Mask<16>* bools) {
    if constexpr (count <= most_joined) return joined_in_narrow_lanes<count, T>(bools);
    const __m512i rows = simd::narrow_rows_of_pairs<count, int{8 * sizeof(T)}>(&bools->bits);
    if constexpr (sizeof(T) == 2)
        return simd::reinterpret<NarrowVector<T>>(_mm512_maskz_extracti64x4_epi64(0xff, rows, 0));
    else
        return simd::reinterpret<NarrowVector<T>>(rows);
}

template <int count>
RDDL_INLINE auto narrow_bits_of(const Mask<16>* bools) {
    using T = std::conditional_t<narrow_width(count) == 15, std::int16_t, std::int32_t>;
    return narrow<T>(narrow_lanes_of<count, T>(bools), [bools](int i) RDDL_INLINE_LAMBDA {
        return i < count ? bools[i] : Mask<16>(false);
    });
}

}  // namespace detail

template <class T, class A, class B>
RDDL_INLINE auto bit_and(const detail::NarrowBits<T, A>& a, const detail::NarrowBits<T, B>& b) {
    return detail::narrow<T>(a.bits & b.bits, [a = a.masks, b = b.masks](int i)
                                                  RDDL_INLINE_LAMBDA { return a(i) && b(i); });
}
template <class T, class A, class B>
RDDL_INLINE auto bit_or(const detail::NarrowBits<T, A>& a, const detail::NarrowBits<T, B>& b) {
    return detail::narrow<T>(a.bits | b.bits, [a = a.masks, b = b.masks](int i)
                                                  RDDL_INLINE_LAMBDA { return a(i) || b(i); });
}
template <class T, class A, class B>
RDDL_INLINE auto bit_xor(const detail::NarrowBits<T, A>& a, const detail::NarrowBits<T, B>& b) {
    return detail::narrow<T>(a.bits ^ b.bits, [a = a.masks, b = b.masks](int i)
                                                  RDDL_INLINE_LAMBDA { return a(i) != b(i); });
}
template <class T, class A>
RDDL_INLINE auto bit_and(const detail::NarrowBits<T, A>& a, std::int64_t b) {
    return detail::narrow<T>(a.bits & static_cast<T>(b),
                             [a = a.masks, b](int i)
                                 RDDL_INLINE_LAMBDA { return a(i) && detail::mask_of_bit(b, i); });
}
template <class T, class A>
RDDL_INLINE auto bit_or(const detail::NarrowBits<T, A>& a, std::int64_t b) {
    return detail::narrow<T>(a.bits | static_cast<T>(b),
                             [a = a.masks, b](int i)
                                 RDDL_INLINE_LAMBDA { return a(i) || detail::mask_of_bit(b, i); });
}
template <class T, class A>
RDDL_INLINE auto bit_xor(const detail::NarrowBits<T, A>& a, std::int64_t b) {
    return detail::narrow<T>(a.bits ^ static_cast<T>(b),
                             [a = a.masks, b](int i)
                                 RDDL_INLINE_LAMBDA { return a(i) != detail::mask_of_bit(b, i); });
}
template <class T, class B>
RDDL_INLINE auto bit_and(std::int64_t a, const detail::NarrowBits<T, B>& b) {
    return bit_and(b, a);
}
template <class T, class B>
RDDL_INLINE auto bit_or(std::int64_t a, const detail::NarrowBits<T, B>& b) {
    return bit_or(b, a);
}
template <class T, class B>
RDDL_INLINE auto bit_xor(std::int64_t a, const detail::NarrowBits<T, B>& b) {
    return bit_xor(b, a);
}
template <class T, class Masks>
RDDL_INLINE Lanes<std::int64_t, 16> count_ones(const detail::NarrowBits<T, Masks>& a) {
    return count_ones(detail::wide(a));
}

#endif

// The elements of a table of at most 31 bools as `bits` has them, for `bit_and`, `bit_or` and
// `bit_xor` with their like and with ints of 16 bits, of 32 for more than 15 bools; for ==, != and
// `count_ones`.
template <bool just_stored = true, class Table>
RDDL_INLINE auto narrow_bits(const Table& table) {
    constexpr auto count = static_cast<int>(detail::element_count<Table>);
    static_assert(narrow_width(count) > 0);
    const auto* const bools = detail::first_element(table);
#ifdef RDDL_SIMD_SQUARES
    if constexpr (std::is_same_v<decltype(bools), const Mask<16>* const>)
        return detail::narrow_bits_of<count>(bools);
    else
#endif
        return detail::bits_of<count, just_stored>(bools);
}
// The bits of the caller's actions.
template <class Table>
RDDL_INLINE auto narrow_action_bits(const Table& table) {
    return narrow_bits<false>(table);
}

}  // namespace rddl
