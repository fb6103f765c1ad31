// Bools of rows, a byte each, into masks over the rows and back: 8 rows and 64 columns at once.
#pragma once

#include <rddl/lanes/bit_squares.hpp>
#include <rddl/lanes/pack.hpp>
#include <rddl/lanes/simd.hpp>
#include <rddl/values/bit_matrix.hpp>
#include <rddl/values/pack_ops.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace rddl::inline RDDL_SIMD_LEVEL {

#ifdef RDDL_SIMD_AVX512
// Rows of few bytes are read as one run of bytes, and a column has the bits that lie a row apart.
inline constexpr std::int64_t widest_narrow_row = 16;

// By distance: bits that lie so far apart, from bit 0 on.
inline constexpr auto bits_apart = [] {
    std::array<std::uint64_t, widest_narrow_row + 1> bits{};
    for (std::size_t distance = 1; distance < bits.size(); ++distance)
        for (std::size_t i = 0; i < 64; i += distance) bits[distance] |= std::uint64_t{1} << i;
    return bits;
}();
// `count` bools of each of n rows, which have at most `widest_narrow_row` bytes.
template <int n>
RDDL_ALWAYS_INLINE void read_narrow_rows(const std::byte* rows, std::int64_t row_size,
                                         std::int64_t count, Mask<n>* masks) {
    const std::int64_t byte_count = (n - 1) * row_size + count;
#pragma GCC unroll 16
    for (std::int64_t k = 0; k < count; ++k) {
        std::uint64_t column = 0;
        int lanes = 0;
        for (std::int64_t first = 0; first < byte_count; first += 64) {
            const auto some = static_cast<int>(std::min<std::int64_t>(64, byte_count - first));
            const std::int64_t phase = ((k - first) % row_size + row_size) % row_size;
            const std::uint64_t own = bits_apart[static_cast<std::size_t>(row_size)] << phase;
            column |= _pext_u64(simd::bits_of_bytes(rows + first, some), own) << lanes;
            lanes += __builtin_popcountll(own);
        }
        masks[k] = Mask<n>::of_bits(column);
    }
}
#endif

#ifdef RDDL_SIMD_SQUARES
// By the bytes of a row: where the first bools of 16 rows lie, then the second ones, up to the
// fourth.
inline constexpr auto places_of_four_columns = [] {
    struct alignas(64) {
        std::uint8_t of[widest_narrow_row + 1][64];
    } places{};
    for (int size = 0; size <= widest_narrow_row; ++size)
        for (int i = 0; i < 64; ++i)
            places.of[size][i] = static_cast<std::uint8_t>(i % 16 * size + i / 16);
    return places;
}();
// Whole columns are chosen from up to four registers of rows, so that a test makes their masks.
RDDL_ALWAYS_INLINE void read_narrow_rows_by_bytes(const std::byte* rows, std::int64_t row_size,
                                                  std::int64_t count, Mask<16>* masks) {
    constexpr std::uint64_t all = ~std::uint64_t{0};
    const std::int64_t byte_count = 15 * row_size + count;
    __m512i bytes[4];
    for (std::int64_t i = 0; i < 4; ++i) {
        const std::int64_t there = std::clamp<std::int64_t>(byte_count - 64 * i, 0, 64);
        bytes[i] = there == 0 ? _mm512_setzero_si512()
                              : _mm512_maskz_loadu_epi8(all >> (64 - there), rows + 64 * i);
    }
    const __m512i first_places = _mm512_load_si512(places_of_four_columns.of[row_size]);
#pragma GCC unroll 4
    for (std::int64_t k = 0; k < count; k += 4) {
        const __m512i places = simd::reinterpret<__m512i>(
            simd::reinterpret<bit_matrix::BitColumns>(first_places) + static_cast<std::uint8_t>(k));
        __m512i columns = byte_count > 64
                              ? _mm512_maskz_permutex2var_epi8(all, bytes[0], places, bytes[1])
                              : _mm512_maskz_permutexvar_epi8(all, places, bytes[0]);
        if (byte_count > 128)
            columns = _mm512_mask_blend_epi8(
                _mm512_movepi8_mask(places), columns,
                _mm512_maskz_permutex2var_epi8(all, bytes[2], places, bytes[3]));
        const std::uint64_t bits = _mm512_test_epi8_mask(columns, columns);
        for (std::int64_t i = 0; i < 4 && k + i < count; ++i)
            masks[k + i] = Mask<16>::of_bits(bits >> (16 * i));
    }
}
#endif

#ifdef RDDL_SIMD_SQUARES
// Rows that lie one behind the other are tested as one run, 64 bytes at a time, not each by itself.
// The bits of 8 rows then are as many bytes as a row has bools. The bits of a row begin at one of
// the 8 bits of some byte, and take at most 8 bytes.
inline constexpr std::int64_t widest_row_of_run = 57;

// By the bools of a row, for 8 rows: the 8 bytes that hold its bits, and where in them these begin.
inline constexpr auto bits_of_row = [] {
    struct alignas(64) Places {
        std::uint8_t bytes[64];
        std::uint64_t begins[8];
    };
    std::array<Places, widest_row_of_run + 1> places{};
    for (std::size_t size = 0; size < places.size(); ++size)
        for (std::size_t i = 0; i < 64; ++i) {
            places[size].bytes[i] = static_cast<std::uint8_t>(size * (i / 8) / 8 + i % 8);
            places[size].begins[i / 8] = size * (i / 8) % 8;
        }
    return places;
}();
// The bits of at most 512 bytes.
RDDL_ALWAYS_INLINE __m512i bits_of_run(const std::byte* bytes, std::int64_t count) {
    __m512i bits = _mm512_setzero_si512();
#pragma GCC unroll 8
    for (std::int64_t i = 0; i < 8; ++i) {
        const std::int64_t rest = std::clamp<std::int64_t>(count - 64 * i, 0, 64);
        if (rest == 0) break;
        const std::uint64_t some = simd::bits_of_bytes(bytes + 64 * i, static_cast<int>(rest));
        bits = _mm512_mask_set1_epi64(bits, static_cast<__mmask8>(1 << i),
                                      static_cast<std::int64_t>(some));
    }
    return bits;
}
template <int n>
RDDL_ALWAYS_INLINE void read_run_of_rows(const std::byte* rows, std::int64_t count,
                                         Mask<n>* masks) {
    constexpr std::int64_t bytes_at_once = 512, most = n * widest_row_of_run / bytes_at_once + 2;
    __m512i bits[most];
#pragma GCC unroll 9
    for (std::int64_t i = 0; i < most; ++i)
        bits[i] = bits_of_run(rows + i * bytes_at_once, n * count - i * bytes_at_once);
    const auto& places = bits_of_row[static_cast<std::size_t>(count)];
    std::array<bit_matrix::BitColumns, n / 8> columns;
#pragma GCC unroll 8
    for (std::int64_t i = 0; i < n / 8; ++i) {
        const std::int64_t first = i * count / 64, place = i * count % 64;
        const auto bytes = simd::reinterpret<__m512i>(
            simd::reinterpret<bit_matrix::BitColumns>(_mm512_load_si512(places.bytes)) +
            static_cast<std::uint8_t>(place));
        constexpr std::uint64_t all = ~std::uint64_t{0};
        const __m512i found =
            place + count > 64
                ? _mm512_maskz_permutex2var_epi8(all, bits[first], bytes, bits[first + 1])
                : _mm512_maskz_permutexvar_epi8(all, bytes, bits[first]);
        columns[static_cast<std::size_t>(i)] =
            bit_matrix::columns_of(simd::reinterpret<bit_matrix::BitRows>(
                _mm512_maskz_srlv_epi64(0xFF, found, _mm512_load_si512(places.begins))));
    }
    bit_matrix::store_masks(columns, static_cast<int>(count), masks);
}
#endif

// `count` bools of each of the first `present` rows; the others have false ones.
template <int n>
RDDL_ALWAYS_INLINE void read_bools(const std::byte* rows, std::int64_t row_size, int present,
                                   std::int64_t count, Mask<n>* masks) {
#ifdef RDDL_SIMD_SQUARES
    if constexpr (n == 16)
        if (__builtin_constant_p(count * row_size) && row_size <= widest_narrow_row && present == n)
            return read_narrow_rows_by_bytes(rows, row_size, count, masks);
#endif
#ifdef RDDL_SIMD_AVX512
    // Where the compiler knows the rows, few columns of them are a few instructions.
    constexpr std::int64_t most = 2 * widest_narrow_row;
    if (__builtin_constant_p(count * row_size) && row_size <= widest_narrow_row &&
        count * row_size <= most && present == n)
        return read_narrow_rows(rows, row_size, count, masks);
#endif
#ifdef RDDL_SIMD_SQUARES
    if constexpr (n >= 16)
        if (__builtin_constant_p(count * row_size) && count == row_size &&
            count <= widest_row_of_run && present == n)
            return read_run_of_rows(rows, count, masks);
#endif
    for (std::int64_t first = 0; first < count; first += 64) {
        const auto column_count = static_cast<int>(std::min<std::int64_t>(64, count - first));
        const auto row = [&](int lane) RDDL_INLINE_LAMBDA {
            if (lane >= present) return std::uint64_t{0};
            return simd::bits_of_bytes(rows + lane * row_size + first, column_count);
        };
        std::array<bit_matrix::BitColumns, n / 8> columns;
        for (int i = 0; i < n / 8; ++i)
            columns[static_cast<std::size_t>(i)] = bit_matrix::columns_of(bit_matrix::BitRows{
                row(8 * i), row(8 * i + 1), row(8 * i + 2), row(8 * i + 3), row(8 * i + 4),
                row(8 * i + 5), row(8 * i + 6), row(8 * i + 7)});
        bit_matrix::store_masks(columns, column_count, masks + first);
    }
}
template <int n>
void write_bools(const Mask<n>* masks, std::int64_t count, std::byte* rows, std::int64_t row_size,
                 int present) {
    for (std::int64_t first = 0; first < count; first += 64) {
        const auto columns = static_cast<int>(std::min<std::int64_t>(64, count - first));
        for (int lane = 0; lane < present; lane += 8) {
            const auto by_column = bit_matrix::lanes_of(masks + first, columns, lane);
            const bit_matrix::BitRows chunk = bit_matrix::rows_of(by_column);
            for (int i = 0; i < 8 && lane + i < present; ++i)
                simd::store_as_bytes<64>(chunk[static_cast<std::size_t>(i)],
                                         rows + (lane + i) * row_size + first, columns);
        }
    }
}

// So few masks are joined one by one: where masks choose the lanes of registers, that is an
// instruction or two for each, and none of them waits in memory for its neighbours.
#ifdef RDDL_SIMD_AVX512
inline constexpr int most_joined = 8;
#else
inline constexpr int most_joined = 0;
#endif
template <int count, int n>
RDDL_INLINE Lanes<std::int64_t, n> joined_in_lanes(const Mask<n>* masks) {
    Lanes<std::int64_t, n> bits{std::int64_t{0}};
    for (int i = 0; i < count; ++i)
        for (int p = 0; p < bits.part_count; ++p) {
            const auto chosen = static_cast<simd::MaskBits>(masks[i].bits >> (p * simd::lanes) &
                                                            simd::all_lanes_of<std::int64_t>);
            const simd::Ints zero{}, one = zero + (std::int64_t{1} << i);
            bits.part[p] |= simd::blend(chosen, one, zero);
        }
    return bits;
}

// The bits that `count` <= 64 masks have in each lane, that of the first one lowest.
template <int count, int n>
Lanes<std::int64_t, n> bits_in_lanes(const Mask<n>* masks) {
    if constexpr (count <= most_joined && n <= 16) return joined_in_lanes<count>(masks);
    Lanes<std::uint64_t, n> bits;
#ifdef RDDL_SIMD_SQUARES
    if constexpr (n == 16) {
        const auto rows = simd::rows_of_pairs<count>(&masks->bits);
        bits.part[0] = simd::reinterpret<simd::Words>(rows.low);
        bits.part[1] = simd::reinterpret<simd::Words>(rows.high);
        return ints_of(bits);
    }
    if constexpr (n == 64) {
        const simd::RegistersOfRows rows = simd::rows_of_words<count>(&masks->bits);
        for (int p = 0; p < 8; ++p) bits.part[p] = simd::reinterpret<simd::Words>(rows.of[p]);
        return ints_of(bits);
    }
#elif defined(__AVX2__) && !defined(RDDL_SIMD_AVX512)
    if constexpr (n == 64) {
        const auto rows = bit_matrix::rows_of_words<count>(&masks->bits);
        std::memcpy(&bits.part, &rows, sizeof rows);
        return ints_of(bits);
    }
#endif
    constexpr int parts = 8 / bits.part_width;
    for (int i = 0; i < n / 8; ++i) {
        const bit_matrix::BitRows rows =
            bit_matrix::rows_of(bit_matrix::lanes_of(masks, count, 8 * i));
        std::memcpy(&bits.part[parts * i], &rows, sizeof rows);
    }
    return ints_of(bits);
}

// The reverse: the lowest `count` <= 64 bits of each lane.
template <int count, int n>
void store_lanes(const Lanes<std::int64_t, n>& lanes, Mask<n>* masks) {
    const Lanes<std::uint64_t, n> bits = words_of(lanes);
#ifdef RDDL_SIMD_SQUARES
    if constexpr (n == 16) {
        simd::store_as_pairs<count>(
            {simd::reinterpret<__m512i>(bits.part[0]), simd::reinterpret<__m512i>(bits.part[1])},
            &masks->bits);
        return;
    }
#endif
    constexpr int parts = 8 / bits.part_width;
    std::array<bit_matrix::BitColumns, n / 8> columns;
    for (int i = 0; i < n / 8; ++i) {
        bit_matrix::BitRows rows;
        std::memcpy(&rows, &bits.part[parts * i], sizeof rows);
        columns[static_cast<std::size_t>(i)] = bit_matrix::columns_of(rows);
    }
    bit_matrix::store_masks(columns, count, masks);
}

}  // namespace rddl::inline RDDL_SIMD_LEVEL
