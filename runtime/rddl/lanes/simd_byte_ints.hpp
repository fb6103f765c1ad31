// Registers of ints of a byte, where a register has one for each of 64 environments: with AVX-512
// VBMI (RDDL_SIMD_BYTE_INTS).
#pragma once

#include <rddl/lanes/simd.hpp>
#include <rddl/lanes/simd_moves.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>

#ifdef __AVX512VBMI__
#define RDDL_SIMD_BYTE_INTS
#endif

namespace rddl::simd::inline RDDL_SIMD_LEVEL {

template <>
struct VectorOf<std::int8_t> {
    typedef std::int8_t type __attribute__((vector_size(register_bytes)));
};
using ByteInts = Vector<std::int8_t>;
// Their sums and products wrap around.
typedef std::uint8_t ByteWords __attribute__((vector_size(register_bytes)));

#ifdef RDDL_SIMD_BYTE_INTS

[[gnu::always_inline]] inline std::uint64_t less(ByteInts a, ByteInts b) {
    return _mm512_cmp_epi8_mask((__m512i)a, (__m512i)b, _MM_CMPINT_LT);
}
[[gnu::always_inline]] inline std::uint64_t less_equal(ByteInts a, ByteInts b) {
    return _mm512_cmp_epi8_mask((__m512i)a, (__m512i)b, _MM_CMPINT_LE);
}
[[gnu::always_inline]] inline std::uint64_t equal(ByteInts a, ByteInts b) {
    return _mm512_cmp_epi8_mask((__m512i)a, (__m512i)b, _MM_CMPINT_EQ);
}

// a where the bit is set, else b.
[[gnu::always_inline]] inline ByteInts blend(std::uint64_t mask, ByteInts a, ByteInts b) {
    return (ByteInts)_mm512_mask_blend_epi8(mask, (__m512i)b, (__m512i)a);
}

// How many bits of each byte are 1: a table has those of half a byte.
[[gnu::always_inline]] inline ByteInts count_ones(ByteInts a) {
    constexpr std::uint64_t all = ~std::uint64_t{0};
    const __m512i halves = _mm512_set1_epi8(15);
    const __m512i ones = _mm512_maskz_broadcast_i32x4(
        0xFFFF, _mm_setr_epi8(0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4));
    const __m512i low = (__m512i)a & halves;
    const __m512i high = _mm512_maskz_srli_epi16(0xFFFFFFFF, (__m512i)a, 4) & halves;
    return (ByteInts)((ByteWords)_mm512_maskz_shuffle_epi8(all, ones, low) +
                      (ByteWords)_mm512_maskz_shuffle_epi8(all, ones, high));
}
// The lanes in which that bit is 1.
[[gnu::always_inline]] inline std::uint64_t lanes_of_bit(ByteInts a, int bit) {
    return _mm512_test_epi8_mask((__m512i)a, _mm512_set1_epi8(static_cast<char>(1 << bit)));
}
// The sum of 2^i over all masks that have the lane, 8 at most.
template <int count>
[[gnu::always_inline]] inline ByteInts joined_masks(const std::uint64_t* masks) {
    __m512i bits = _mm512_setzero_si512();
    for (int i = 0; i < count; ++i)
        bits |= _mm512_maskz_set1_epi8(masks[i], static_cast<char>(1 << i));
    return (ByteInts)bits;
}

// The elements at these places of a table of at most 64 bools or ints, which are bytes.
template <int count>
[[gnu::always_inline]] inline ByteInts look_up_bytes(const bool* table, ByteInts places) {
    constexpr std::uint64_t all = ~std::uint64_t{0};
    const __m512i bytes = _mm512_maskz_loadu_epi8(all >> (64 - count), table);
    return (ByteInts)_mm512_maskz_permutexvar_epi8(all, (__m512i)places, bytes);
}
template <int count>
[[gnu::always_inline]] inline ByteInts look_up_bytes(const std::int64_t* table, ByteInts places) {
    Words bytes{};
    for (int i = 0; 8 * i < count; ++i) {
        const auto some =
            static_cast<__mmask8>(0xFF >> (8 - (count - 8 * i < 8 ? count - 8 * i : 8)));
        const __m512i ints = _mm512_maskz_loadu_epi64(some, table + 8 * i);
        bytes[i] =
            static_cast<std::uint64_t>(_mm_cvtsi128_si64(_mm512_maskz_cvtepi64_epi8(0xFF, ints)));
    }
    return (ByteInts)_mm512_maskz_permutexvar_epi8(~std::uint64_t{0}, (__m512i)places,
                                                   (__m512i)bytes);
}

// Bytes as the ints of a register.
[[gnu::always_inline]] inline Ints widened(const std::int8_t* bytes) {
    return (Ints)_mm512_maskz_cvtepi8_epi64(0xFF, _mm_loadl_epi64((const __m128i_u*)bytes));
}

// The same as floats.
[[gnu::always_inline]] inline Floats floats_of(const std::int8_t* bytes) {
    const __m128i some = _mm_loadu_si128((const __m128i_u*)bytes);
    return _mm512_maskz_cvtepi32_ps(0xFFFF, _mm512_maskz_cvtepi8_epi32(0xFFFF, some));
}

namespace detail {

// For each two of 8 registers of ints: where the bytes of the result lie in them, and which
// they are. The ints are rows of `columns`, and become the columns one behind the other.
struct LowestBytes {
    alignas(64) std::uint8_t places[4][64];
    std::uint64_t are_there[4];
};
template <int columns>
constexpr LowestBytes make_lowest_bytes() {
    constexpr int rows = 64 / columns, ints_of_two = 16, bytes_of_int = 8;
    LowestBytes made{};
    for (int k = 0; k < 64; ++k) {
        const int to = k % columns * rows + k / columns;
        made.places[k / ints_of_two][to] =
            static_cast<std::uint8_t>(k % ints_of_two * bytes_of_int);
        made.are_there[k / ints_of_two] |= std::uint64_t{1} << to;
    }
    return made;
}
template <int columns>
inline constexpr LowestBytes lowest_bytes = make_lowest_bytes<columns>();

// 64 ints, rows of so many columns. `any` gets the bits of all.
template <int columns>
[[gnu::always_inline]] inline Words columns_of_bytes(const void* ints, Words& any) {
    const auto* from = static_cast<const char*>(ints);
    __m512i all = _mm512_setzero_si512();
    for (int two = 0; two < 4; ++two, from += 2 * register_bytes) {
        const auto places = _mm512_load_si512(lowest_bytes<columns>.places[two]);
        const auto first = _mm512_loadu_si512(from);
        const auto second = _mm512_loadu_si512(from + register_bytes);
        any |= (Words)(first | second);
        all |= _mm512_maskz_permutex2var_epi8(lowest_bytes<columns>.are_there[two], first, places,
                                              second);
    }
    return (Words)all;
}

// Transposes `count` registers of as many parts of `distance * 8` bytes and more.
template <int count, int step, int distance>
[[gnu::always_inline]] inline void transpose_parts(Words* registers) {
    for (int i = 0; i < count; ++i)
        if ((i & step) == 0)
            exchange<distance>(registers[i], registers[i + step],
                               std::make_index_sequence<lanes>());
    if constexpr (step > 1) transpose_parts<count, step / 2, distance / 2>(registers);
}

}  // namespace detail

// The lowest bytes of 64 ints.
[[gnu::always_inline]] inline ByteInts narrowed(const Ints* ints) {
    Words any{};
    return (ByteInts)detail::columns_of_bytes<1>(ints, any);
}
// The same of 64 rows of 2, 4 or 8 ints, one behind the other. `any` gets the bits of all.
template <int count>
[[gnu::always_inline]] inline void narrow_rows(const void* rows, ByteInts (&columns)[count],
                                               Words& any) {
    Words registers[count];
    for (int i = 0; i < count; ++i)
        registers[i] =
            detail::columns_of_bytes<count>(static_cast<const char*>(rows) + 512 * i, any);
    detail::transpose_parts<count, count / 2, lanes / 2>(registers);
    for (int i = 0; i < count; ++i) columns[i] = (ByteInts)registers[i];
}

#else

template <class V>
std::uint64_t lanes_of_bit(V a, int bit) = delete;
template <int count, class T>
ByteInts joined_masks(const T* masks) = delete;
template <int count, class T>
ByteInts look_up_bytes(const T* table, ByteInts places) = delete;
template <class T>
Ints widened(const T* bytes) = delete;
template <class T>
Floats floats_of(const T* bytes) = delete;
template <class V>
ByteInts narrowed(const V* ints) = delete;
template <int count, class V>
void narrow_rows(const void* rows, V (&columns)[count], Words& any) = delete;

#endif

}  // namespace rddl::simd::inline RDDL_SIMD_LEVEL
