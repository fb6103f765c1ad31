// Matrices of bits in registers, by squares of 8 x 8: processors that permute the bytes of a
// register (VBMI) also transpose a register of squares by one instruction (GFNI).
#pragma once

#include <rddl/lanes/simd.hpp>

#include <array>
#include <cstdint>

#ifdef RDDL_SIMD_AVX512

namespace rddl::simd::inline RDDL_SIMD_LEVEL {

// The places from which the elements of a register come when they are permuted.
template <class Element, int count, class Source>
inline constexpr auto sources = [] {
    struct alignas(64) {
        std::array<Element, count> of;
    } all{};
    for (int i = 0; i < count; ++i) all.of[i] = static_cast<Element>(Source{}(i));
    return all;
}();

#if defined(__AVX512VBMI__) && defined(__GFNI__)
#define RDDL_SIMD_SQUARES

// Byte i of a word is row 7 - i of a square, and row i of the result.
inline __m512i transposed_from_below(__m512i squares) {
    const __m512i unit = _mm512_set1_epi64(static_cast<std::int64_t>(0x8040201008040201));
    return _mm512_maskz_gf2p8affine_epi64_epi8(~std::uint64_t{0}, unit, squares, 0);
}

// Byte i of the result is byte source(i) of a register, or of two, one behind the other.
template <class Source>
[[gnu::always_inline]] inline __m512i permuted_bytes(__m512i a, Source) {
    const __m512i places = _mm512_load_si512(&sources<std::uint8_t, 64, Source>);
    return _mm512_maskz_permutexvar_epi8(~std::uint64_t{0}, places, a);
}
template <class Source>
[[gnu::always_inline]] inline __m512i permuted_bytes(__m512i a, __m512i b, Source) {
    const __m512i places = _mm512_load_si512(&sources<std::uint8_t, 64, Source>);
    return _mm512_maskz_permutex2var_epi8(~std::uint64_t{0}, a, places, b);
}

// 8 rows of 64 bits as 64 columns of 8 bits, and columns as rows.
inline __m512i columns_of_rows(__m512i rows) {
    return transposed_from_below(
        permuted_bytes(rows, [](int i) { return 8 * (7 - i % 8) + i / 8; }));
}
inline __m512i rows_of_columns(__m512i columns) {
    const __m512i squares =
        transposed_from_below(permuted_bytes(columns, [](int i) { return i ^ 7; }));
    return permuted_bytes(squares, [](int i) { return i % 8 * 8 + i / 8; });
}

// Quarters of two registers, the first of two numbers from `a` and the others from `b`.
template <int numbers>
[[gnu::always_inline]] inline __m512i quarters_of(__m512i a, __m512i b) {
    return _mm512_maskz_shuffle_i64x2(0xFF, a, b, numbers);
}
// The registers are 8 rows of 64 bytes; their 64 columns of 8 bytes, one after the other.
struct RegistersOfRows {
    __m512i of[8];
};
[[gnu::always_inline]] inline RegistersOfRows columns_of_bytes(const RegistersOfRows& rows) {
    constexpr int even = 0x88, odd = 0xDD;
    RegistersOfRows columns;
    // Words first: those with even numbers, then the others.
    for (int first = 0; first < 2; ++first) {
        const auto pairs = [&](int i) __attribute__((always_inline)) {
            return first == 0 ? _mm512_maskz_unpacklo_epi64(0xFF, rows.of[i], rows.of[i + 1])
                              : _mm512_maskz_unpackhi_epi64(0xFF, rows.of[i], rows.of[i + 1]);
        };
        const __m512i a = pairs(0), b = pairs(2), c = pairs(4), d = pairs(6);
        const __m512i ab = quarters_of<even>(a, b), cd = quarters_of<even>(c, d),
                      other_ab = quarters_of<odd>(a, b), other_cd = quarters_of<odd>(c, d);
        columns.of[first] = quarters_of<even>(ab, cd);
        columns.of[first + 2] = quarters_of<even>(other_ab, other_cd);
        columns.of[first + 4] = quarters_of<odd>(ab, cd);
        columns.of[first + 6] = quarters_of<odd>(other_ab, other_cd);
    }
    for (__m512i& some : columns.of)
        some = permuted_bytes(some, [](int i) { return i % 8 * 8 + i / 8; });
    return columns;
}
// `count` <= 64 columns of 64 bits as 64 rows of `count` bits, one after the other; the other bits
// of the rows are 0.
template <int count>
[[gnu::always_inline]] inline RegistersOfRows rows_of_words(const std::uint64_t* columns) {
    RegistersOfRows squares;
    for (int i = 0; i < 8; ++i) {
        const auto there = static_cast<std::uint8_t>((~std::uint64_t{0} >> (64 - count)) >> 8 * i);
        squares.of[i] = there == 0
                            ? _mm512_setzero_si512()
                            : columns_of_rows(_mm512_maskz_loadu_epi64(there, columns + 8 * i));
    }
    return columns_of_bytes(squares);
}

// `count` <= 64 columns of 16 bits as 16 rows of `count` bits in two registers; the other bits of
// the rows are 0. A register of squares has those of the upper 8 rows behind those of the lower 8.
struct TwoRegisters {
    __m512i low, high;
};
template <int count>
[[gnu::always_inline]] inline __m512i squares_of_pairs(const std::uint16_t* columns, int first) {
    const auto there = static_cast<std::uint32_t>((~std::uint64_t{0} >> (64 - count)) >> first);
    const __m512i pairs = _mm512_maskz_loadu_epi16(there, columns + first);
    return transposed_from_below(
        permuted_bytes(pairs, [](int i) { return 2 * (8 * (i / 8 % 4) + 7 - i % 8) + i / 32; }));
}
template <int count>
[[gnu::always_inline]] inline TwoRegisters rows_of_pairs(const std::uint16_t* columns) {
    constexpr auto in_low = [](int i) {
        return i % 8 * 8 + i / 8 + i % 8 / 4 * 32;
    };
    constexpr auto in_high = [](int i) {
        return i % 8 * 8 + i / 8 + i % 8 / 4 * 32 + 32;
    };
    const __m512i first = squares_of_pairs<count>(columns, 0);
    if constexpr (count > 32) {
        const __m512i second = squares_of_pairs<count>(columns, 32);
        return {permuted_bytes(first, second, in_low), permuted_bytes(first, second, in_high)};
    } else {
        const __m512i zero = _mm512_setzero_si512();
        return {permuted_bytes(first, zero, in_low), permuted_bytes(first, zero, in_high)};
    }
}
// The same of at most 16 or 32 columns, as rows of so many bits from the start of the register.
template <int count, int row_bits>
[[gnu::always_inline]] inline __m512i narrow_rows_of_pairs(const std::uint16_t* columns) {
    static_assert(count <= row_bits && row_bits <= 32);
    return permuted_bytes(squares_of_pairs<count>(columns, 0), [](int i) {
        constexpr int bytes = row_bits / 8;
        const int row = i / bytes % 16, group = i % bytes;
        return 8 * (4 * (row / 8) + group) + row % 8;
    });
}
// The reverse of the rows in two registers.
template <int count>
[[gnu::always_inline]] inline void store_as_pairs(TwoRegisters rows, std::uint16_t* columns) {
    const auto store = [&](int first, __m512i squares) __attribute__((always_inline)) {
        const auto there = static_cast<std::uint32_t>((~std::uint64_t{0} >> (64 - count)) >> first);
        const __m512i pairs = permuted_bytes(transposed_from_below(squares),
                                             [](int i) { return i % 2 * 32 + i / 2; });
        _mm512_mask_storeu_epi16(columns + first, there, pairs);
    };
    store(0, permuted_bytes(rows.low, rows.high,
                            [](int i) { return i / 32 * 64 + 8 * (7 - i % 8) + i / 8 % 4; }));
    if constexpr (count > 32)
        store(32, permuted_bytes(rows.low, rows.high, [](int i) {
                  return i / 32 * 64 + 8 * (7 - i % 8) + i / 8 % 4 + 4;
              }));
}

#endif

}  // namespace rddl::simd::inline RDDL_SIMD_LEVEL

#endif
