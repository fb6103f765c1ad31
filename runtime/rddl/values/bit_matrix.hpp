// Matrices of bits, transposed by squares of 8 x 8: masks of lanes, and the bools of rows as bits.
#pragma once

#include <rddl/lanes/bit_squares.hpp>
#include <rddl/lanes/pack.hpp>
#include <rddl/lanes/simd.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace rddl::inline RDDL_SIMD_LEVEL::bit_matrix {

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

#elif defined(__AVX2__)

// 8 words in two registers.
struct Square {
    __m256i low, high;
};
RDDL_ALWAYS_INLINE Square load_square(const void* from) {
    const auto* const registers = static_cast<const __m256i_u*>(from);
    return {_mm256_loadu_si256(registers), _mm256_loadu_si256(registers + 1)};
}
RDDL_ALWAYS_INLINE void store_square(const Square& square, void* to) {
    auto* const registers = static_cast<__m256i_u*>(to);
    _mm256_storeu_si256(registers, square.low);
    _mm256_storeu_si256(registers + 1, square.high);
}
// Byte i of word k becomes byte k of word i.
RDDL_ALWAYS_INLINE Square bytes_exchanged(const Square& words) {
    const __m256i in_turn = _mm256_broadcastsi128_si256(
        _mm_setr_epi8(0, 8, 1, 9, 2, 10, 3, 11, 4, 12, 5, 13, 6, 14, 7, 15));
    const __m256i low = _mm256_shuffle_epi8(words.low, in_turn),
                  high = _mm256_shuffle_epi8(words.high, in_turn);
    const __m256i first = _mm256_permute2x128_si256(low, high, 0x20),
                  second = _mm256_permute2x128_si256(low, high, 0x31);
    const __m256i halves = _mm256_setr_epi32(0, 4, 1, 5, 2, 6, 3, 7);
    return {_mm256_permutevar8x32_epi32(_mm256_unpacklo_epi16(first, second), halves),
            _mm256_permutevar8x32_epi32(_mm256_unpackhi_epi16(first, second), halves)};
}
RDDL_ALWAYS_INLINE Square all_transposed(const Square& squares) {
    using Four = std::uint64_t __attribute__((vector_size(32)));
    return {simd::reinterpret<__m256i>(transposed(simd::reinterpret<Four>(squares.low))),
            simd::reinterpret<__m256i>(transposed(simd::reinterpret<Four>(squares.high)))};
}

// Words in registers of their own would be stored one by one and loaded together, which is slow.
RDDL_ALWAYS_INLINE Square square_of(const BitRows& rows) {
    const auto four = [&](std::size_t i) RDDL_INLINE_LAMBDA {
        const auto word = [&](std::size_t k) RDDL_INLINE_LAMBDA {
            return static_cast<std::int64_t>(rows[i + k]);
        };
        return _mm256_setr_epi64x(word(0), word(1), word(2), word(3));
    };
    return {four(0), four(4)};
}
RDDL_ALWAYS_INLINE BitColumns columns_of(const BitRows& rows) {
    BitColumns columns;
    store_square(all_transposed(bytes_exchanged(square_of(rows))), &columns);
    return columns;
}
RDDL_ALWAYS_INLINE BitRows rows_of(const BitColumns& columns) {
    BitRows rows;
    store_square(bytes_exchanged(all_transposed(load_square(&columns))), &rows);
    return rows;
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

#if defined(__AVX2__) && !defined(RDDL_SIMD_AVX512)
// Masks of 16 lanes: bytes of pairs, and pairs of bytes.
RDDL_ALWAYS_INLINE BitColumns lanes_of_pairs(const std::uint16_t* masks, int count, int lane) {
    const auto sixteen = [&](int first) RDDL_INLINE_LAMBDA {
        const auto bytes_of = [&](int k) RDDL_INLINE_LAMBDA {
            if (k >= count) return __m128i{};
            const int rest = count - k;
            const __m128i bits = simd::load_parts(masks + k, rest < 8 ? 2 * rest : 16);
            return _mm_and_si128(_mm_srl_epi16(bits, _mm_cvtsi32_si128(lane)),
                                 _mm_set1_epi16(0xFF));
        };
        return first < count ? _mm_packus_epi16(bytes_of(first), bytes_of(first + 8)) : __m128i{};
    };
    BitColumns columns;
    store_square(
        {_mm256_set_m128i(sixteen(16), sixteen(0)), _mm256_set_m128i(sixteen(48), sixteen(32))},
        &columns);
    return columns;
}
RDDL_ALWAYS_INLINE void store_pairs(const BitColumns& low, const BitColumns& high, int count,
                                    std::uint16_t* masks) {
    for (int k = 0; k < count; k += 8) {
        const auto bytes_in = [k](const BitColumns& columns) RDDL_INLINE_LAMBDA {
            return _mm_loadl_epi64(
                reinterpret_cast<const __m128i_u*>(&columns[static_cast<std::size_t>(k)]));
        };
        const __m128i bits = _mm_unpacklo_epi8(bytes_in(low), bytes_in(high));
        const int rest = count - k;
        simd::store_parts(masks + k, bits, rest < 8 ? 2 * rest : 16);
    }
}

// Masks of 64 lanes.
RDDL_ALWAYS_INLINE void store_words(const std::array<BitColumns, 8>& columns, int count,
                                    std::uint64_t* masks) {
    for (int k = 0; k < count; k += 8) {
        BitRows some_words;
        for (std::size_t i = 0; i < 8; ++i)
            std::memcpy(&some_words[i], &columns[i][static_cast<std::size_t>(k)],
                        sizeof some_words[i]);
        const Square square = bytes_exchanged(square_of(some_words));
        if (k + 8 <= count) {
            store_square(square, masks + k);
        } else {
            store_square(square, &some_words);
            std::copy_n(some_words.begin(), count - k, masks + k);
        }
    }
}
// The bits that `count` masks have in each lane, that of the first one lowest.
template <int count>
RDDL_INLINE std::array<BitRows, 8> rows_of_words(const std::uint64_t* masks) {
    std::array<BitRows, 8> squares{};  // of 8 masks
    for (int i = 0; 8 * i < count; ++i) {
        BitRows some{};
        std::copy_n(masks + 8 * i, std::min(8, count - 8 * i), some.begin());
        const Square by_lanes = 8 * i + 8 <= count ? load_square(masks + 8 * i) : square_of(some);
        store_square(all_transposed(bytes_exchanged(by_lanes)),
                     &squares[static_cast<std::size_t>(i)]);
    }
    std::array<BitRows, 8> rows;
    for (std::size_t g = 0; g < 8; ++g) {
        const BitRows some_words{squares[0][g], squares[1][g], squares[2][g], squares[3][g],
                                 squares[4][g], squares[5][g], squares[6][g], squares[7][g]};
        store_square(bytes_exchanged(square_of(some_words)), &rows[g]);
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
#elif defined(__AVX2__)
    if constexpr (n == 16) return lanes_of_pairs(&masks->bits, count, lane);
#endif
    BitColumns columns{};
    for (int k = 0; k < count; ++k)
        columns[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(masks[k].bits >> lane);
    return columns;
}

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
#ifdef RDDL_SIMD_SQUARES
    if constexpr (n == 64) {
        simd::RegistersOfRows bytes;
        for (std::size_t i = 0; i < columns.size(); ++i)
            bytes.of[i] = simd::reinterpret<__m512i>(columns[i]);
        bytes = simd::columns_of_bytes(bytes);
        for (int i = 0; 8 * i < count; ++i)
            _mm512_mask_storeu_epi64(masks + 8 * i, static_cast<std::uint8_t>(there >> 8 * i),
                                     bytes.of[i]);
        return;
    }
#endif
    if constexpr (n == 64) {
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
        return;
    }
#elif defined(__AVX2__)
    if constexpr (n == 16) return store_pairs(columns[0], columns[1], count, &masks->bits);
    if constexpr (n == 64) return store_words(columns, count, &masks->bits);
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

}  // namespace rddl::inline RDDL_SIMD_LEVEL::bit_matrix
