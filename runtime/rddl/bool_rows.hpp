// Bools of rows, a byte each, into masks over the rows and back: 8 rows and 64 columns at once.
#pragma once

#include <rddl/pack.hpp>
#include <rddl/simd.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace rddl::inline RDDL_SIMD_LEVEL {

namespace bit_matrix {

// A matrix of bits by rows, and by columns, row 0 lowest.
using BitRows = std::array<std::uint64_t, 8>;
using BitColumns = std::array<std::uint8_t, 64>;

// Of matrices of 8 x 8, byte i being row i (H. Warren, Hacker's Delight, section 7-3).
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

#ifdef RDDL_SIMD_AVX512

// Where bytes and pairs of bytes come from when 8 rows of 8 bytes become 8 columns, or columns
// rows.
template <class Element, int count, class Source>
inline constexpr auto sources = [] {
    struct alignas(64) {
        std::array<Element, count> of;
    } all{};
    for (int i = 0; i < count; ++i) all.of[i] = static_cast<Element>(Source{}(i));
    return all;
}();
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
    const auto two_rows_together = shuffled_bytes(_mm512_loadu_si512(rows.data()),
                                                  &sources<std::uint8_t, 64, decltype(bytes)>);
    const auto all_together =
        permuted_pairs(two_rows_together, &sources<std::uint16_t, 32, decltype(pairs)>);
    return std::bit_cast<BitColumns>(transposed(simd::reinterpret<simd::Words>(all_together)));
}
inline BitRows rows_of(const BitColumns& columns) {
    constexpr auto pairs = [](int i) {
        return i % 8 * 4 + i / 8;
    };
    constexpr auto bytes = [](int i) {
        return i % 8 * 2 + i % 16 / 8;
    };
    const auto transposed_squares = transposed(std::bit_cast<simd::Words>(columns));
    const auto two_rows_together = permuted_pairs(simd::reinterpret<__m512i>(transposed_squares),
                                                  &sources<std::uint16_t, 32, decltype(pairs)>);
    return std::bit_cast<BitRows>(
        shuffled_bytes(two_rows_together, &sources<std::uint8_t, 64, decltype(bytes)>));
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

}  // namespace bit_matrix

// `count` bools of each of the first `present` rows; the others have false ones.
template <int n>
RDDL_ALWAYS_INLINE void read_bools(const std::byte* rows, std::int64_t row_size, int present,
                                   std::int64_t count, Mask<n>* masks) {
    using Bits = typename Mask<n>::Bits;
    for (std::int64_t first = 0; first < count; first += 64) {
        const auto columns = static_cast<int>(std::min<std::int64_t>(64, count - first));
        std::array<Bits, 64> bits{};
        for (int lane = 0; lane < present; lane += 8) {
            bit_matrix::BitRows chunk{};
            for (int i = 0; i < 8 && lane + i < present; ++i)
                chunk[static_cast<std::size_t>(i)] =
                    simd::bits_of_bytes(rows + (lane + i) * row_size + first, columns);
            const bit_matrix::BitColumns by_column = bit_matrix::columns_of(chunk);
            for (std::size_t k = 0; k < 64; ++k)
                bits[k] = static_cast<Bits>(bits[k] | static_cast<Bits>(by_column[k]) << lane);
        }
        static_assert(sizeof(Mask<n>) == sizeof(Bits));
        std::memcpy(masks + first, bits.data(), static_cast<std::size_t>(columns) * sizeof(Bits));
    }
}
template <int n>
void write_bools(const Mask<n>* masks, std::int64_t count, std::byte* rows, std::int64_t row_size,
                 int present) {
    for (std::int64_t first = 0; first < count; first += 64) {
        const auto columns = static_cast<int>(std::min<std::int64_t>(64, count - first));
        for (int lane = 0; lane < present; lane += 8) {
            bit_matrix::BitColumns by_column{};
            for (int k = 0; k < columns; ++k)
                by_column[static_cast<std::size_t>(k)] =
                    static_cast<std::uint8_t>(masks[first + k].bits >> lane);
            const bit_matrix::BitRows chunk = bit_matrix::rows_of(by_column);
            for (int i = 0; i < 8 && lane + i < present; ++i)
                simd::store_as_bytes<64>(chunk[static_cast<std::size_t>(i)],
                                         rows + (lane + i) * row_size + first, columns);
        }
    }
}

// The bits that `count` <= 64 masks have in each lane, that of the first one lowest.
template <int count, int n>
Lanes<std::int64_t, n> bits_in_lanes(const Mask<n>* masks) {
    std::array<std::int64_t, static_cast<std::size_t>(n)> bits;
    for (int lane = 0; lane < n; lane += 8) {
        bit_matrix::BitColumns by_column{};
        for (int k = 0; k < count; ++k)
            by_column[static_cast<std::size_t>(k)] =
                static_cast<std::uint8_t>(masks[k].bits >> lane);
        const bit_matrix::BitRows chunk = bit_matrix::rows_of(by_column);
        std::memcpy(&bits[static_cast<std::size_t>(lane)], &chunk, sizeof chunk);
    }
    return Lanes<std::int64_t, n>::load(bits.data());
}

}  // namespace rddl::inline RDDL_SIMD_LEVEL
