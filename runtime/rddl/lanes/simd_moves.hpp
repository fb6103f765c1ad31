// Lanes of registers (simd.hpp) to and from memory, and from lane to lane.
#pragma once

#include <rddl/lanes/simd.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>

namespace rddl::simd::inline RDDL_SIMD_LEVEL {

// The first `count` lanes of a register; `count` may be 0 or more than it has; zeros in the others.
// No more is read or written.
template <class T>
[[gnu::always_inline]] inline Vector<T> load_some(const T* from, int count) {
#ifdef RDDL_SIMD_AVX512
    const std::uint32_t some =
        _bzhi_u32(all_lanes_of<T>, static_cast<unsigned>(count < 0 ? 0 : count));
    if constexpr (sizeof(T) == 8)
        return reinterpret<Vector<T>>(_mm512_maskz_loadu_pd(static_cast<__mmask8>(some), from));
    else
        return reinterpret<Vector<T>>(_mm512_maskz_loadu_ps(static_cast<__mmask16>(some), from));
#else
    Vector<T> result{};
    for (int i = 0; i < lanes_of<T> && i < count; ++i) result[i] = from[i];
    return result;
#endif
}
// At most so many values are loaded one by one, or in pairs (simd_halves.hpp).
inline constexpr int most_in_pairs = 4;
template <class T>
[[gnu::always_inline]] inline void store_some(T* to, Vector<T> values, int count) {
#ifdef RDDL_SIMD_AVX512
    const std::uint32_t some =
        _bzhi_u32(all_lanes_of<T>, static_cast<unsigned>(count < 0 ? 0 : count));
    if constexpr (sizeof(T) == 8)
        _mm512_mask_storeu_pd(to, static_cast<__mmask8>(some), reinterpret<Reals>(values));
    else
        _mm512_mask_storeu_ps(to, static_cast<__mmask16>(some), reinterpret<Floats>(values));
#else
    for (int i = 0; i < lanes_of<T> && i < count; ++i) to[i] = values[i];
#endif
}

#ifdef RDDL_SIMD_AVX512

// One of the lanes in all of them.
[[gnu::always_inline]] inline Reals in_all_lanes(Reals values, int lane) {
    return _mm512_maskz_permutexvar_pd(0xFF, _mm512_set1_epi64(lane), values);
}
// The lanes so many places further on, behind zeros. A parameter of the template, since without
// optimisation compilers take no other constant for an immediate operand.
template <int places>
[[gnu::always_inline]] inline Reals moved_on(Reals values) {
    return (Reals)_mm512_maskz_alignr_epi64(0xFF, (__m512i)values, __m512i{}, lanes - places);
}
// The sum of each lane and of all lanes before it, in three additions.
[[gnu::always_inline]] inline Reals running_sums(Reals values) {
    values += moved_on<1>(values);
    values += moved_on<2>(values);
    values += moved_on<4>(values);
    return values;
}

#endif

// -------------------------------------------------------------------------------- gathering

[[gnu::always_inline]] inline Reals gather(const double* from, Ints indices) {
#ifdef RDDL_SIMD_AVX512
    return _mm512_mask_i64gather_pd(Reals{}, 0xFF, (__m512i)indices, from, 8);
#elif defined(__AVX2__)
    return _mm256_i64gather_pd(from, (__m256i)indices, 8);
#else
    Reals result{};
    for (int i = 0; i < lanes; ++i) result[i] = from[indices[i]];
    return result;
#endif
}
// Looks up entries of a table of `count` values, which registers may be able to hold.
template <std::int64_t count>
[[gnu::always_inline]] inline Reals look_up(const double* table, Ints indices) {
#ifdef RDDL_SIMD_AVX512
    if constexpr (count <= 16) {
        constexpr int first_half = count < 8 ? count : 8, second_half = count - first_half;
        const Reals first = _mm512_maskz_loadu_pd((1 << first_half) - 1, table);
        if constexpr (second_half == 0)
            return _mm512_maskz_permutexvar_pd(0xFF, (__m512i)indices, first);
        const Reals second = _mm512_maskz_loadu_pd((1 << second_half) - 1, table + first_half);
        return _mm512_permutex2var_pd(first, (__m512i)indices, second);
    } else if constexpr (count <= 32) {
        const __mmask8 beyond =
            _mm512_test_epi64_mask((__m512i)indices, _mm512_set1_epi64(std::int64_t{16}));
        return _mm512_mask_mov_pd(look_up<16>(table, indices), beyond,
                                  look_up<count - 16>(table + 16, indices));
    }
#endif
    return gather(table, indices);
}
[[gnu::always_inline]] inline Floats gather(const float* from, Ints first, Ints second) {
#ifdef RDDL_SIMD_AVX512
    const __m256 low =
        _mm512_mask_i64gather_ps(__m256{}, 0xFF, reinterpret<__m512i>(first), from, 4);
    const __m256 high =
        _mm512_mask_i64gather_ps(__m256{}, 0xFF, reinterpret<__m512i>(second), from, 4);
    return _mm512_insertf32x8(_mm512_castps256_ps512(low), high, 1);
#else
    Floats result{};
    for (int i = 0; i < lanes; ++i) result[i] = from[first[i]];
    for (int i = 0; i < lanes; ++i) result[lanes + i] = from[second[i]];
    return result;
#endif
}
// Looks up entries of a table of `count` values, which registers may be able to hold.
template <std::int64_t count>
[[gnu::always_inline]] inline Floats look_up(const float* table, Ints first, Ints second) {
#ifdef RDDL_SIMD_AVX512
    if constexpr (count <= 32) {
        const __m512i lower_halves =
            _mm512_set_epi32(30, 28, 26, 24, 22, 20, 18, 16, 14, 12, 10, 8, 6, 4, 2, 0);
        const __m512i places =
            _mm512_permutex2var_epi32((__m512i)first, lower_halves, (__m512i)second);
        constexpr int first_half = count < 16 ? count : 16, second_half = count - first_half;
        const Floats low = _mm512_maskz_loadu_ps((1 << first_half) - 1, table);
        if constexpr (second_half == 0) {
            return _mm512_maskz_permutexvar_ps(0xFFFF, places, low);
        } else {
            const Floats high = _mm512_maskz_loadu_ps((1 << second_half) - 1, table + first_half);
            return _mm512_permutex2var_ps(low, places, high);
        }
    }
#endif
    return gather(table, first, second);
}
[[gnu::always_inline]] inline Ints gather(const std::int64_t* from, Ints indices) {
    return reinterpret<Ints>(gather(reinterpret_cast<const double*>(from), indices));
}

// The 8 bytes from each offset on in an object of `size` bytes; behind its end there are zeros, and
// nothing is read there.
template <std::int64_t size>
[[gnu::always_inline]] inline Words gather_bytes(const void* from, Ints offsets) {
    if constexpr (size < 8) {
        std::uint64_t all = 0;
        __builtin_memcpy(&all, from, size);
        return (Words{} + all) >> (Words)(offsets * 8);
    } else {
        const Ints last = Ints{} + (size - 8);
        const Ints begin = offsets < last ? offsets : last;
        Words words{};
#if defined(RDDL_SIMD_AVX512)
        words = (Words)_mm512_mask_i64gather_epi64(__m512i{}, 0xFF, (__m512i)begin, from, 1);
#elif defined(__AVX2__)
        words =
            (Words)_mm256_i64gather_epi64(static_cast<const long long*>(from), (__m256i)begin, 1);
#else
        for (int i = 0; i < lanes; ++i) {
            std::uint64_t word;
            __builtin_memcpy(&word, static_cast<const char*>(from) + begin[i], sizeof word);
            words[i] = word;
        }
#endif
        return words >> (Words)((offsets - begin) * 8);
    }
}

// The elements at these places of a table of `count` unsigned ints, which registers may be able to
// hold, in the lowest bits of words; what the other bits are is open.
template <std::int64_t count, class T>
[[gnu::always_inline]] inline Words look_up_lowest(const T* table, Ints places) {
#ifdef RDDL_SIMD_AVX512
    if constexpr (sizeof(T) == 2 && count <= 32) {
        constexpr auto all = static_cast<__mmask32>((std::uint64_t{1} << count) - 1);
        return (Words)_mm512_maskz_permutexvar_epi16(~__mmask32{0}, (__m512i)places,
                                                     _mm512_maskz_loadu_epi16(all, table));
    }
#endif
    constexpr auto size = static_cast<std::int64_t>(sizeof(T));
    return gather_bytes<count * size>(table, places * size);
}

// Values of 8 bytes whose addresses are `distance` bytes apart.
template <class V>
[[gnu::always_inline]] inline V load_apart(const void* from, std::int64_t distance) {
    static_assert(sizeof(V{}[0]) == 8);
    V result{};
#if defined(RDDL_SIMD_AVX512)
    const Ints numbers = {0, 1, 2, 3, 4, 5, 6, 7};
    result = (V)_mm512_mask_i64gather_pd(Reals{}, 0xFF, (__m512i)(numbers * distance), from, 1);
#else
    for (int i = 0; i < lanes; ++i) {
        std::remove_cvref_t<decltype(result[0])> value;
        __builtin_memcpy(&value, static_cast<const char*>(from) + i * distance, sizeof value);
        result[i] = value;
    }
#endif
    return result;
}

// -------------------------------------------------------------------------------- matrices

namespace detail {

// Exchanges the lanes whose numbers differ from the row's in bit `distance`: rows[i] gets lanes of
// rows[i + distance], and gives its own for them.
template <int distance, class V, std::size_t... lane>
[[gnu::always_inline]] inline void exchange(V& row, V& later, std::index_sequence<lane...>) {
    constexpr std::size_t d = distance, all = sizeof...(lane);
    const V first =
        __builtin_shufflevector(row, later, ((lane & d) == 0 ? lane : all + lane - d)...);
    later = __builtin_shufflevector(row, later, ((lane & d) == 0 ? lane + d : all + lane)...);
    row = first;
}
template <int distance, class V>
[[gnu::always_inline]] inline void exchange_all(V* rows) {
    for (int i = 0; i < lanes; ++i)
        if ((i & distance) == 0)
            exchange<distance>(rows[i], rows[i + distance], std::make_index_sequence<lanes>());
}

}  // namespace detail

// Transposes as many registers of 64-bit values as each has lanes.
template <class V>
[[gnu::always_inline]] inline void transpose(V* rows) {
    static_assert(sizeof(V{}[0]) == 8);
    if constexpr (lanes > 4) detail::exchange_all<4>(rows);
    if constexpr (lanes > 2) detail::exchange_all<2>(rows);
    detail::exchange_all<1>(rows);
}

#ifdef RDDL_SIMD_AVX512
namespace detail {

// At most four values at each place, side by side.
[[gnu::always_inline]] inline __m512d load_halves(const std::byte* low, const std::byte* high,
                                                  int count) {
    const auto load = [&](const std::byte* from) __attribute__((always_inline)) {
        const auto* const values = reinterpret_cast<const double*>(from);
        if (count >= 4) return _mm256_loadu_pd(values);
        return _mm256_maskz_loadu_pd(static_cast<__mmask8>((1 << count) - 1), values);
    };
    return _mm512_maskz_insertf64x4(0xFF, _mm512_maskz_insertf64x4(0xFF, __m512d{}, load(low), 0),
                                    load(high), 1);
}

}  // namespace detail
#endif

// Transposes as many rows as a register has lanes, of `count` values of 8 bytes each, at most as
// many: the columns beyond are zero. AVX-512 makes the first exchange by its loads.
template <class V>
[[gnu::always_inline]] inline void load_transposed(const std::byte* rows, std::int64_t row_size,
                                                   int count, V* columns) {
    static_assert(sizeof(V{}[0]) == 8);
#ifdef RDDL_SIMD_AVX512
    for (int i = 0; i < 4; ++i) {
        const std::byte *const low = rows + i * row_size, *const high = low + 4 * row_size;
        columns[i] = reinterpret<V>(detail::load_halves(low, high, count));
        columns[i + 4] = V{};
        if (count > 4)
            columns[i + 4] = reinterpret<V>(detail::load_halves(low + 32, high + 32, count - 4));
    }
    detail::exchange_all<2>(columns);
    detail::exchange_all<1>(columns);
#else
    using Value = std::remove_cvref_t<decltype(columns[0][0])>;
    for (int i = 0; i < lanes; ++i) {
        const std::byte* const row = rows + i * row_size;
        if (count == lanes)
            __builtin_memcpy(&columns[i], row, sizeof columns[i]);
        else
            columns[i] = load_some(reinterpret_cast<const Value*>(row), count);
    }
    transpose(columns);
#endif
}

namespace detail {

template <class V, std::size_t... lane>
[[gnu::always_inline]] inline void separate_pairs(V& a, V& b, std::index_sequence<lane...>) {
    const V first = __builtin_shufflevector(a, b, (2 * lane)...);
    b = __builtin_shufflevector(a, b, (2 * lane + 1)...);
    a = first;
}

}  // namespace detail

// Neighbours that are pairs: all first ones, and all second ones.
template <class V>
[[gnu::always_inline]] inline void separate_pairs(V& a, V& b) {
    detail::separate_pairs(a, b, std::make_index_sequence<sizeof(V) / sizeof(V{}[0])>());
}

// ------------------------------------------------------------------------ some of the lanes

// The lanes of several registers where the mask holds, 8 at most, one after the other; `others` in
// the rest of the 8.
template <int count>
[[gnu::always_inline]] inline void compress(std::uint64_t mask, const Reals (&from)[count],
                                            double others, double (&to)[8]) {
    int next = 0;
#ifdef RDDL_SIMD_AVX512
    Reals selected{};
    for (int p = 0; p < count; ++p) {
        const auto bits = static_cast<__mmask8>(mask >> (p * lanes));
        const auto behind = static_cast<__mmask8>(0xFFu << next);
        selected = _mm512_mask_expand_pd(selected, behind, _mm512_maskz_compress_pd(bits, from[p]));
        next += __builtin_popcount(bits);
    }
    selected = blend(0xFFu << next, Reals{} + others, selected);
    __builtin_memcpy(to, &selected, sizeof selected);
#else
    for (double& value : to) value = others;
    for (; mask != 0; mask &= mask - 1) {
        const int lane = __builtin_ctzll(mask);
        to[next++] = from[lane / lanes][lane % lanes];
    }
#endif
}
// Expands back to where the mask holds; the other lanes stay.
template <int count>
[[gnu::always_inline]] inline void expand(std::uint64_t mask, const double (&from)[8],
                                          Reals (&to)[count]) {
    int next = 0;
#ifdef RDDL_SIMD_AVX512
    const Reals values = _mm512_maskz_loadu_pd(0xFF, from);
    for (int p = 0; p < count; ++p) {
        const auto bits = static_cast<__mmask8>(mask >> (p * lanes));
        const auto behind = static_cast<__mmask8>(0xFFu << next);
        to[p] = _mm512_mask_expand_pd(to[p], bits, _mm512_maskz_compress_pd(behind, values));
        next += __builtin_popcount(bits);
    }
#else
    for (; mask != 0; mask &= mask - 1) {
        const int lane = __builtin_ctzll(mask);
        to[lane / lanes][lane % lanes] = from[next++];
    }
#endif
}

// Stores the lanes where the mask holds, one after the other, in memory that has room for a
// register; returns how many there are.
[[gnu::always_inline]] inline int store_chosen(MaskBits mask, Reals from, double* to) {
#ifdef RDDL_SIMD_AVX512
    const auto bits = static_cast<__mmask8>(mask);
    _mm512_storeu_pd(to, _mm512_maskz_compress_pd(bits, from));
#else
    int next = 0;
    for (std::uint64_t rest = mask; rest != 0; rest &= rest - 1)
        to[next++] = from[__builtin_ctzll(rest)];
#endif
    return __builtin_popcount(mask);
}
// Loads the lanes where the mask holds from there; the others stay. Returns how many it has loaded.
[[gnu::always_inline]] inline int load_chosen(MaskBits mask, const double* from, Reals& target) {
#ifdef RDDL_SIMD_AVX512
    const auto bits = static_cast<__mmask8>(mask);
    target = _mm512_mask_expand_pd(target, bits, _mm512_loadu_pd(from));
#else
    int next = 0;
    for (std::uint64_t rest = mask; rest != 0; rest &= rest - 1)
        target[__builtin_ctzll(rest)] = from[next++];
#endif
    return __builtin_popcount(mask);
}

}  // namespace rddl::simd::inline RDDL_SIMD_LEVEL
