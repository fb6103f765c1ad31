// Matrices of 8 rows and 64 columns of bits, in registers: rows become columns and back, and
// columns become masks over the rows.
#pragma once

#include <rddl/lanes/bit_squares.hpp>
#include <rddl/lanes/pack.hpp>
#include <rddl/lanes/simd.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

namespace rddl::inline RDDL_SIMD_LEVEL {

namespace bit_matrix {

// A matrix of 8 x 64 bits by rows, and by columns, row 0 lowest.
#ifdef RDDL_SIMD_AVX512
using BitRows = simd::Words;
using BitColumns = std::uint8_t __attribute__((vector_size(64)));
#else
using BitRows = std::array<std::uint64_t, 8>;
using BitColumns = std::array<std::uint8_t, 64>;
#endif

// Transposes matrices of 8 x 8, byte i being row i (H. Warren, Hacker's Delight, section 7-3).
template <class Word>
RDDL_INLINE Word transposed(Word a) {
    const auto swap = [&](std::uint64_t mask, int distance) RDDL_INLINE_LAMBDA {
        const Word moved = (a ^ a >> distance) & mask;
        a ^= moved ^ moved << distance;
    };
    swap(0x00AA00AA00AA00AA, 7);
    swap(0x0000CCCC0000CCCC, 14);
    swap(0x00000000F0F0F0F0, 28);
    return a;
}

#if defined(RDDL_SIMD_SQUARES)

inline BitColumns columns_of(const BitRows& rows) {
    return simd::reinterpret<BitColumns>(simd::columns_of_rows(simd::reinterpret<__m512i>(rows)));
}
inline BitRows rows_of(const BitColumns& columns) {
    return simd::reinterpret<BitRows>(simd::rows_of_columns(simd::reinterpret<__m512i>(columns)));
}

#elif defined(RDDL_SIMD_AVX512)

inline __m512i shuffled_bytes(__m512i a, const void* places) {
    return _mm512_maskz_shuffle_epi8(~std::uint64_t{0}, a, _mm512_load_si512(places));
}
inline __m512i permuted_pairs(__m512i a, const void* places) {
    return _mm512_maskz_permutexvar_epi16(~std::uint32_t{0}, _mm512_load_si512(places), a);
}

inline BitColumns columns_of(const BitRows& rows) {
    constexpr auto bytes = [](int i) {
        return i % 16 / 2 + i % 2 * 8;
    };
    constexpr auto pairs = [](int i) {
        return i % 4 * 8 + i / 4;
    };
    const auto two_rows_together = shuffled_bytes(
        simd::reinterpret<__m512i>(rows), &simd::sources<std::uint8_t, 64, decltype(bytes)>);
    const auto all_together =
        permuted_pairs(two_rows_together, &simd::sources<std::uint16_t, 32, decltype(pairs)>);
    return simd::reinterpret<BitColumns>(transposed(simd::reinterpret<simd::Words>(all_together)));
}
inline BitRows rows_of(const BitColumns& columns) {
    constexpr auto pairs = [](int i) {
        return i % 8 * 4 + i / 8;
    };
    constexpr auto bytes = [](int i) {
        return i % 8 * 2 + i % 16 / 8;
    };
    const auto transposed_squares = transposed(simd::reinterpret<simd::Words>(columns));
    const auto two_rows_together =
        permuted_pairs(simd::reinterpret<__m512i>(transposed_squares),
                       &simd::sources<std::uint16_t, 32, decltype(pairs)>);
    return simd::reinterpret<BitRows>(
        shuffled_bytes(two_rows_together, &simd::sources<std::uint8_t, 64, decltype(bytes)>));
}

#else

inline BitColumns columns_of(const BitRows& rows) {
    BitColumns columns;
    for (std::size_t square = 0; square < 8; ++square) {
        std::uint64_t bits = 0;
        for (std::size_t i = 0; i < 8; ++i) bits |= (rows[i] >> 8 * square & 0xFF) << 8 * i;
        bits = transposed(bits);
        std::memcpy(&columns[8 * square], &bits, sizeof bits);
    }
    return columns;
}
inline BitRows rows_of(const BitColumns& columns) {
    BitRows rows{};
    for (std::size_t square = 0; square < 8; ++square) {
        std::uint64_t bits;
        std::memcpy(&bits, &columns[8 * square], sizeof bits);
        bits = transposed(bits);
        for (std::size_t i = 0; i < 8; ++i) rows[i] |= (bits >> 8 * i & 0xFF) << 8 * square;
    }
    return rows;
}

#endif

// The lanes [lane, lane + 8) of `count` <= 64 masks, a column each; the other columns are zero.
template <int n>
RDDL_INLINE BitColumns lanes_of(const Mask<n>* masks, int count, int lane) {
#ifdef RDDL_SIMD_AVX512
    const std::uint64_t there = ~std::uint64_t{0} >> (64 - count);
    if constexpr (n == 8)
        return simd::reinterpret<BitColumns>(_mm512_maskz_loadu_epi8(there, masks));
    if constexpr (n == 16) {
        const auto half = [&](int first) RDDL_INLINE_LAMBDA {
            constexpr std::uint32_t all = ~std::uint32_t{0};
            const __m512i bits =
                _mm512_maskz_loadu_epi16(static_cast<std::uint32_t>(there >> first), masks + first);
            return _mm512_maskz_cvtepi16_epi8(
                all, _mm512_maskz_srli_epi16(all, bits, static_cast<unsigned>(lane)));
        };
        return simd::reinterpret<BitColumns>(
            _mm512_maskz_inserti64x4(0xFF, _mm512_castsi256_si512(half(0)), half(32), 1));
    }
    if constexpr (n == 64) {
        // A byte of each of 8 masks.
        const auto bytes_of = [&](int first) RDDL_INLINE_LAMBDA {
            const __m512i bits =
                _mm512_maskz_loadu_epi64(static_cast<std::uint8_t>(there >> first), masks + first);
            return _mm_cvtsi128_si64(_mm512_maskz_cvtepi64_epi8(
                0xFF, _mm512_maskz_srli_epi64(0xFF, bits, static_cast<unsigned>(lane))));
        };
        return simd::reinterpret<BitColumns>(
            _mm512_set_epi64(bytes_of(56), bytes_of(48), bytes_of(40), bytes_of(32), bytes_of(24),
                             bytes_of(16), bytes_of(8), bytes_of(0)));
    }
#endif
    BitColumns columns{};
    for (int k = 0; k < count; ++k)
        columns[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(masks[k].bits >> lane);
    return columns;
}

#ifdef RDDL_SIMD_SQUARES
// The bytes of columns 8 * `chunk` and following, of 8 registers, as words.
template <int chunk>
RDDL_ALWAYS_INLINE __m512i words_of_columns(const __m512i* rows) {
    constexpr int half = chunk / 4, in_half = chunk % 4;
    // Registers i and i + 4 side by side; then those two with i + 1 and i + 5.
    const auto joined = [&](int i) RDDL_INLINE_LAMBDA {
        return _mm512_maskz_shuffle_i64x2(0xFF, rows[i], rows[i + 4], half == 0 ? 0x44 : 0xEE);
    };
    const auto two = [&](int i) RDDL_INLINE_LAMBDA {
        return in_half % 2 == 0 ? _mm512_maskz_unpacklo_epi64(0xFF, joined(i), joined(i + 1))
                                : _mm512_maskz_unpackhi_epi64(0xFF, joined(i), joined(i + 1));
    };
    return simd::permuted_bytes(two(0), two(2), [](int i) {
        const int row = i % 8, column = i / 8;
        return row % 4 / 2 * 64 + row / 4 * 32 + in_half / 2 * 16 + row % 2 * 8 + column;
    });
}
template <std::size_t... chunk>
RDDL_ALWAYS_INLINE void store_masks_of_64(const std::array<BitColumns, 8>& columns, int count,
                                          Mask<64>* masks, std::index_sequence<chunk...>) {
    const std::uint64_t there = ~std::uint64_t{0} >> (64 - count);
    __m512i rows[8];
    for (std::size_t i = 0; i < 8; ++i) rows[i] = simd::reinterpret<__m512i>(columns[i]);
    const auto store = [&]<int k>(std::integral_constant<int, k>) RDDL_INLINE_LAMBDA {
        if (8 * k < count)
            _mm512_mask_storeu_epi64(masks + 8 * k, static_cast<std::uint8_t>(there >> (8 * k)),
                                     words_of_columns<k>(rows));
    };
    (store(std::integral_constant<int, static_cast<int>(chunk)>()), ...);
}
#endif

// The reverse, for all lanes: element i of `columns` has those from 8 i on.
template <int n>
RDDL_INLINE void store_masks(const std::array<BitColumns, n / 8>& columns, int count,
                             Mask<n>* masks) {
#ifdef RDDL_SIMD_AVX512
    const std::uint64_t there = ~std::uint64_t{0} >> (64 - count);
    if constexpr (n == 8) {
        _mm512_mask_storeu_epi8(masks, there, simd::reinterpret<__m512i>(columns[0]));
        return;
    }
    if constexpr (n == 16) {
        const auto store_half = [&](int first, __m256i low, __m256i high) RDDL_INLINE_LAMBDA {
            constexpr std::uint32_t all = ~std::uint32_t{0};
            const __m512i bits =
                _mm512_maskz_cvtepu8_epi16(all, low) |
                _mm512_maskz_slli_epi16(all, _mm512_maskz_cvtepu8_epi16(all, high), 8);
            _mm512_mask_storeu_epi16(masks + first, static_cast<std::uint32_t>(there >> first),
                                     bits);
        };
        const auto low = simd::reinterpret<__m512i>(columns[0]),
                   high = simd::reinterpret<__m512i>(columns[1]);
        store_half(0, _mm512_maskz_extracti64x4_epi64(0xF, low, 0),
                   _mm512_maskz_extracti64x4_epi64(0xF, high, 0));
        store_half(32, _mm512_maskz_extracti64x4_epi64(0xF, low, 1),
                   _mm512_maskz_extracti64x4_epi64(0xF, high, 1));
        return;
    }
    if constexpr (n == 64) {
#ifdef RDDL_SIMD_SQUARES
        store_masks_of_64(columns, count, masks, std::make_index_sequence<8>());
#else
        for (int first = 0; first < count; first += 8) {
            __m512i bits = _mm512_setzero_si512();
            for (unsigned i = 0; i < 8; ++i) {
                // clang++ takes no address of an element.
                const auto* const bytes_of_columns =
                    reinterpret_cast<const std::uint8_t*>(&columns[i]);
                const __m128i bytes =
                    _mm_loadl_epi64(reinterpret_cast<const __m128i*>(bytes_of_columns + first));
                bits |=
                    _mm512_maskz_slli_epi64(0xFF, _mm512_maskz_cvtepu8_epi64(0xFF, bytes), 8 * i);
            }
            _mm512_mask_storeu_epi64(masks + first, static_cast<std::uint8_t>(there >> first),
                                     bits);
        }
#endif
        return;
    }
#endif
    using Bits = typename Mask<n>::Bits;
    for (int k = 0; k < count; ++k) {
        Bits bits{0};
        for (std::size_t i = 0; i < columns.size(); ++i)
            bits = static_cast<Bits>(
                bits | static_cast<Bits>(columns[i][static_cast<std::size_t>(k)]) << 8 * i);
        masks[k] = Mask<n>::of_bits(bits);
    }
}

}  // namespace bit_matrix

}  // namespace rddl::inline RDDL_SIMD_LEVEL
