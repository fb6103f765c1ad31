// Lanes of registers (simd.hpp) to and from memory, and from lane to lane.
#pragma once

#include <rddl/lanes/simd.hpp>

#include <cstddef>
#include <cstdint>
#include <type_traits>
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

// ---------------------------------------------------------------------------- bytes by place

#ifdef __AVX512VBMI__
namespace detail {

// By the lower 7 bits of their places, those that are there.
template <int size>
[[gnu::always_inline]] inline std::uint64_t bits_of_chosen_bytes(const char* table,
                                                                 std::uint64_t there,
                                                                 __m512i places) {
    const __m512i first = load_many_parts(table, size < 64 ? size : 64);
    __m512i chosen;
    if constexpr (size <= 64)
        chosen = _mm512_maskz_permutexvar_epi8(there, places, first);
    else
        chosen = _mm512_maskz_permutex2var_epi8(there, first, places,
                                                load_many_parts(table + 64, size - 64));
    return _mm512_test_epi8_mask(chosen, chosen);
}

}  // namespace detail
#elif defined(__AVX2__)
namespace detail {

// The bytes of a table of `size` <= 128 that have these places: 16 of the table at a time, from
// which the other places take zero (adding 0x70 sets the highest bit of what is 16 or more).
template <int size>
[[gnu::always_inline]] inline __m256i chosen_bytes(const char* table, __m256i places) {
    __m256i chosen = _mm256_setzero_si256();
#pragma GCC unroll 8
    for (int i = 0; i < size; i += 16) {
        // The last ones overlap those before: a part would be loaded by way of the stack.
        const int first = size < 16 || i + 16 <= size ? i : size - 16;
        __m128i some = _mm_setzero_si128();
        __builtin_memcpy(&some, table + first, size < 16 ? size : 16);
        const __m256i from_first =
            _mm256_sub_epi8(places, _mm256_set1_epi8(static_cast<char>(first)));
        chosen = _mm256_or_si256(
            chosen, _mm256_shuffle_epi8(_mm256_broadcastsi128_si256(some),
                                        _mm256_adds_epu8(from_first, _mm256_set1_epi8(0x70))));
    }
    return chosen;
}

}  // namespace detail
#endif

// n bytes, in the parts in which store_bytes and store_as_bytes store them: processors are slow to
// load what was stored in other parts. Zeros behind them.
template <class V, int n>
[[gnu::always_inline]] inline V load_bytes(const void* from) {
    V values{};
#ifdef RDDL_SIMD_AVX512
    if constexpr (n < register_bytes) return reinterpret<V>(load_many_parts(from, n));
#endif
    __builtin_memcpy(&values, from, n);
    return values;
}
// The same of constants, which are loaded as a whole.
template <class V, int n>
[[gnu::always_inline]] inline V load_constant_bytes(const void* from) {
#ifdef RDDL_SIMD_AVX512
    return reinterpret<V>(_mm512_maskz_loadu_epi8(~std::uint64_t{0} >> (64 - n), from));
#else
    return load_bytes<V, n>(from);
#endif
}
template <int n, class V>
[[gnu::always_inline]] inline void store_bytes(V values, void* to) {
#ifdef RDDL_SIMD_AVX512
    if constexpr (n < register_bytes) {
        const auto store = [&]<int i>(std::integral_constant<int, i>)
            __attribute__((always_inline)) {
            if constexpr (i < n)
                store_parts(
                    static_cast<char*>(to) + i,
                    _mm512_maskz_extracti32x4_epi32(0xF, reinterpret<__m512i>(values), i / 16),
                    n - i < 16 ? n - i : 16);
        };
        store(std::integral_constant<int, 0>());
        store(std::integral_constant<int, 16>());
        store(std::integral_constant<int, 32>());
        store(std::integral_constant<int, 48>());
        return;
    }
#endif
    __builtin_memcpy(to, &values, n);
}

// A bit for each byte of a register that is not 0; and the bytes of 0 and 1 for such bits.
template <class V>
[[gnu::always_inline]] inline std::uint64_t nonzero_bytes(V bytes) {
#ifdef RDDL_SIMD_AVX512
    return _mm512_test_epi8_mask(reinterpret<__m512i>(bytes), reinterpret<__m512i>(bytes));
#else
    return bits_of_bytes(&bytes, register_bytes);
#endif
}
template <class V>
[[gnu::always_inline]] inline V bytes_for_bits(std::uint64_t bits) {
#ifdef RDDL_SIMD_AVX512
    return reinterpret<V>(_mm512_maskz_set1_epi8(bits, 1));
#else
    V bytes;
    store_as_bytes<register_bytes>(bits, &bytes, register_bytes);
    return bytes;
#endif
}

// The bytes of a table of `size` <= most_chosen_bytes that have these places.
#if defined(__AVX512VBMI__)
inline constexpr std::int64_t most_chosen_bytes = 256;
template <std::int64_t size, class V>
[[gnu::always_inline]] inline V chosen_bytes(const void* table, V bytes_of_places) {
    constexpr __mmask64 all = ~std::uint64_t{0};
    const auto places = reinterpret<__m512i>(bytes_of_places);
    const auto part = [&](int first) __attribute__((always_inline)) {
        const int rest = static_cast<int>(size) - first;
        return load_many_parts(static_cast<const char*>(table) + first, rest < 64 ? rest : 64);
    };
    const auto chosen = [&]<int first, int rest>() __attribute__((always_inline)) {
        if constexpr (rest <= 64)
            return _mm512_maskz_permutexvar_epi8(all, places, part(first));
        else
            return _mm512_maskz_permutex2var_epi8(all, part(first), places, part(first + 64));
    };
    const __m512i in_first = chosen.template operator()<0, size>();
    if constexpr (size <= 128)
        return reinterpret<V>(in_first);
    else
        return reinterpret<V>(_mm512_mask_mov_epi8(in_first, _mm512_movepi8_mask(places),
                                                   chosen.template operator()<128, size - 128>()));
}
#elif defined(__AVX2__)
inline constexpr std::int64_t most_chosen_bytes = 128;
template <std::int64_t size, class V>
[[gnu::always_inline]] inline V chosen_bytes(const void* table, V places) {
    constexpr int parts = register_bytes / 32;
    __m256i part[parts];
    __builtin_memcpy(part, &places, sizeof part);
    for (__m256i& some : part)
        some = detail::chosen_bytes<static_cast<int>(size)>(static_cast<const char*>(table), some);
    __builtin_memcpy(&places, part, sizeof part);
    return places;
}
#else
inline constexpr std::int64_t most_chosen_bytes = 0;
template <std::int64_t size, class V>
V chosen_bytes(const void* table, V places) = delete;
#endif

// A bit for each of 0 < `count` <= 64 bytes of a table of `size` that is not 0: those with these
// places.
template <std::int64_t size, class Place>
[[gnu::always_inline]] inline std::uint64_t bits_of_chosen_bytes(const void* table,
                                                                 const Place* places, int count) {
    const char* const bytes = static_cast<const char*>(table);
    std::uint64_t bits = 0;
    int k = 0;
#ifdef __AVX512VBMI__
    if constexpr (sizeof(Place) == 1) {
        const std::uint64_t there = ~std::uint64_t{0} >> (64 - count);
        const __m512i numbers = _mm512_maskz_loadu_epi8(there, places);
        const std::uint64_t in_first =
            detail::bits_of_chosen_bytes<(size < 128 ? size : 128)>(bytes, there, numbers);
        if constexpr (size <= 128) return in_first;
        const std::uint64_t in_second = detail::bits_of_chosen_bytes<(size > 128 ? size - 128 : 1)>(
            bytes + 128, there, numbers);
        const std::uint64_t is_second = _mm512_movepi8_mask(numbers);
        return (in_first & ~is_second) | (in_second & is_second);
    }
#elif defined(__AVX2__)
    if constexpr (sizeof(Place) == 1 && size <= 128) {
        const auto chosen_bits = [&](__m256i numbers) __attribute__((always_inline)) {
            const __m256i chosen = detail::chosen_bytes<static_cast<int>(size)>(bytes, numbers);
            const int zero =
                _mm256_movemask_epi8(_mm256_cmpeq_epi8(chosen, _mm256_setzero_si256()));
            return std::uint64_t{~static_cast<std::uint32_t>(zero)};
        };
        for (; k + 32 <= count; k += 32)
            bits |= chosen_bits(_mm256_loadu_si256(reinterpret_cast<const __m256i_u*>(places + k)))
                    << k;
        if (k + 16 <= count) {
            const __m128i some = _mm_loadu_si128(reinterpret_cast<const __m128i_u*>(places + k));
            bits |= (chosen_bits(_mm256_inserti128_si256(_mm256_setzero_si256(), some, 0)) & 0xFFFF)
                    << k;
            k += 16;
        }
    }
#endif
    for (; k < count; ++k) bits |= std::uint64_t{bytes[places[k]] != 0} << k;
    return bits;
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

}  // namespace rddl::simd::inline RDDL_SIMD_LEVEL
