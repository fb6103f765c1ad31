// Bytes of registers: to and from memory, by their places in tables, and as bits.
#pragma once

#include <rddl/lanes/simd.hpp>

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace rddl::simd::inline RDDL_SIMD_LEVEL {

// ---------------------------------------------------------------------------- bytes by place

#if defined(__AVX2__) && !defined(__AVX512VBMI__)
namespace detail {

// The bytes of a table of `size` <= 128 that have these places: 16 of the table at a time, from
// which the other places take zero (adding 0x70 sets the highest bit of what is 16 or more).
template <int size>
[[gnu::always_inline]] inline __m256i chosen_bytes(const char* table, __m256i places) {
    __m256i chosen = _mm256_setzero_si256();
#pragma GCC unroll 8
    for (int i = 0; i < size; i += 16) {
        const __m128i some = load_parts(table + i, size - i < 16 ? size - i : 16);
        const __m256i from_first = _mm256_sub_epi8(places, _mm256_set1_epi8(static_cast<char>(i)));
        chosen = _mm256_or_si256(
            chosen, _mm256_shuffle_epi8(_mm256_broadcastsi128_si256(some),
                                        _mm256_adds_epu8(from_first, _mm256_set1_epi8(0x70))));
    }
    return chosen;
}

}  // namespace detail
#endif

// n bytes, in the parts in which store_bytes and store_as_bytes store them: processors are slow to
// load what was stored in other parts. Any values behind them.
template <class V, int n>
[[gnu::always_inline]] inline V load_bytes(const void* from) {
    V values{};
#ifdef __SSE2__
    if constexpr (sizeof(V) == 16) return reinterpret<V>(load_parts(from, n));
#endif
#ifdef RDDL_SIMD_AVX512
    if constexpr (sizeof(V) > 16 && n < register_bytes)
        return reinterpret<V>(load_many_parts(from, n));
#elif defined(__AVX2__)
    if constexpr (sizeof(V) > 16 && n < register_bytes) {
        const auto part = [&](int i) __attribute__((always_inline)) {
            const int rest = n - i < 16 ? n - i : 16;
            return rest > 0 ? load_parts(static_cast<const char*>(from) + i, rest)
                            : _mm_setzero_si128();
        };
        return reinterpret<V>(_mm256_set_m128i(part(16), part(0)));
    }
#endif
    __builtin_memcpy(&values, from, n);
    return values;
}
// The same of constants, which are loaded as a whole.
template <class V, int n>
[[gnu::always_inline]] inline V load_constant_bytes(const void* from) {
#ifdef RDDL_SIMD_AVX512
    if constexpr (sizeof(V) == 16)
        return reinterpret<V>(_mm_maskz_loadu_epi8(~std::uint32_t{0} >> (32 - n), from));
    else
        return reinterpret<V>(_mm512_maskz_loadu_epi8(~std::uint64_t{0} >> (64 - n), from));
#else
    return load_bytes<V, n>(from);
#endif
}
template <int n, class V>
[[gnu::always_inline]] inline void store_bytes(V values, void* to) {
#ifdef __SSE2__
    if constexpr (sizeof(V) == 16) return store_parts(to, reinterpret<__m128i>(values), n);
#endif
#ifdef RDDL_SIMD_AVX512
    if constexpr (sizeof(V) > 16 && n < register_bytes) {
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
#elif defined(__AVX2__)
    if constexpr (sizeof(V) > 16 && n < register_bytes) {
        const auto all = reinterpret<__m256i>(values);
        store_parts(to, _mm256_castsi256_si128(all), n < 16 ? n : 16);
        if constexpr (n > 16)
            store_parts(static_cast<char*>(to) + 16, _mm256_extracti128_si256(all, 1), n - 16);
        return;
    }
#endif
    __builtin_memcpy(to, &values, n);
}

// A bit for each byte of a register that is not 0; and the bytes of 0 and 1 for such bits.
template <class V>
[[gnu::always_inline]] inline std::uint64_t nonzero_bytes(V bytes) {
#ifdef RDDL_SIMD_AVX512
    if constexpr (sizeof(V) == 16)
        return _mm_test_epi8_mask(reinterpret<__m128i>(bytes), reinterpret<__m128i>(bytes));
    else
        return _mm512_test_epi8_mask(reinterpret<__m512i>(bytes), reinterpret<__m512i>(bytes));
#elif defined(__AVX2__)
    if constexpr (sizeof(V) == 16)
        return nonzero_bits(reinterpret<__m128i>(bytes));
    else
        return nonzero_bits(reinterpret<__m256i>(bytes));
#else
    return bits_of_bytes(&bytes, register_bytes);
#endif
}
template <class V>
[[gnu::always_inline]] inline V bytes_for_bits(std::uint64_t bits) {
#ifdef RDDL_SIMD_AVX512
    if constexpr (sizeof(V) == 16)
        return reinterpret<V>(_mm_maskz_set1_epi8(static_cast<__mmask16>(bits), 1));
    else
        return reinterpret<V>(_mm512_maskz_set1_epi8(bits, 1));
#elif defined(__AVX2__)
    if constexpr (sizeof(V) == 16)
        return reinterpret<V>(bytes_of_few_bits(bits));
    else
        return reinterpret<V>(bytes_of_many_bits(bits));
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
    // Loops over many objects store full registers as a whole (store_bytes).
    const auto part = [&](int first) __attribute__((always_inline)) {
        const int rest = static_cast<int>(size) - first;
        const char* const from = static_cast<const char*>(table) + first;
        return rest < 64 ? load_many_parts(from, rest) : _mm512_loadu_si512(from);
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
#ifdef __AVX2__
// The same of a small register.
template <std::int64_t size>
[[gnu::always_inline]] inline __m128i few_chosen_bytes(const void* table, __m128i places) {
    const char* const bytes = static_cast<const char*>(table);
    __m128i chosen = _mm_setzero_si128();
#pragma GCC unroll 16
    for (int i = 0; i < static_cast<int>(size); i += 16) {
        const int rest = static_cast<int>(size) - i;
        const __m128i some = load_parts(bytes + i, rest < 16 ? rest : 16);
        const __m128i from_first = _mm_sub_epi8(places, _mm_set1_epi8(static_cast<char>(i)));
        // Adding 0x70 sets the highest bit of places beyond these 16, which then take zero.
        const __m128i among = size <= 16 ? places : _mm_adds_epu8(from_first, _mm_set1_epi8(0x70));
        chosen = _mm_or_si128(chosen, _mm_shuffle_epi8(some, among));
    }
    return chosen;
}
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
    if constexpr (sizeof(Place) == 1 && size <= most_chosen_bytes) {
        const std::uint64_t there = ~std::uint64_t{0} >> (64 - count);
        return nonzero_bytes(chosen_bytes<size>(table, _mm512_maskz_loadu_epi8(there, places))) &
               there;
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

// Whether one of these bytes is not 0. They may have been stored just now, as those of
// bits_of_stored_bytes.
template <int count>
[[gnu::always_inline]] inline bool is_any_stored_byte(const void* bytes) {
    const auto* next = static_cast<const char*>(bytes);
    TwoWords all{};
    for (int i = 0; i + 16 <= count; i += 16, next += 16) {
        TwoWords some;
        __builtin_memcpy(&some, next, sizeof some);
        all |= some;
    }
    std::uint64_t rest = all[0] | all[1];
    const auto add = [&](auto part) __attribute__((always_inline)) {
        if ((count & static_cast<int>(sizeof part)) == 0) return;
        __builtin_memcpy(&part, next, sizeof part);
        rest |= part;
        next += sizeof part;
    };
    add(std::uint64_t{});
    add(std::uint32_t{});
    add(std::uint16_t{});
    add(std::uint8_t{});
    return rest != 0;
}
// The same of the first `count` bytes of a register.
template <int count, class V>
[[gnu::always_inline]] inline bool is_any_byte(const V& bytes) {
#ifdef RDDL_SIMD_AVX512
    if constexpr (count % 2 == 0) {
        constexpr std::uint32_t there = ~std::uint32_t{0} >> (32 - count / 2);
        const auto pairs = reinterpret<__m512i>(bytes);
        return (_mm512_test_epi16_mask(pairs, pairs) & there) != 0;
    }
#endif
    return is_any_stored_byte<count>(&bytes);
}
// Whether one byte is not 0 in all of these rows of bytes, which are 0 or 1.
template <int count, class... Rows>
[[gnu::always_inline]] inline bool is_any_byte_in_all(const Rows*... rows) {
    int first = 0;
    std::uint64_t any = 0;
    const auto add = [&]<class Part>(Part) __attribute__((always_inline)) {
        const auto of_row = [&](const void* row) __attribute__((always_inline)) {
            Part part;
            __builtin_memcpy(&part, static_cast<const char*>(row) + first, sizeof part);
            return part;
        };
        any |= static_cast<std::uint64_t>((of_row(rows) & ...));
        first += static_cast<int>(sizeof(Part));
    };
    while (first + 8 <= count) add(std::uint64_t{});
    if constexpr ((count & 4) != 0) add(std::uint32_t{});
    if constexpr ((count & 2) != 0) add(std::uint16_t{});
    if constexpr ((count & 1) != 0) add(std::uint8_t{});
    return any != 0;
}
// Zeros, in the parts that is_any_stored_byte loads.
template <int count>
[[gnu::always_inline]] inline void clear_bytes(void* bytes) {
    auto* next = static_cast<char*>(bytes);
    const auto clear = [&](auto part) __attribute__((always_inline)) {
        __builtin_memcpy(next, &part, sizeof part);
        next += sizeof part;
    };
    for (int i = 0; i + 16 <= count; i += 16) clear(TwoWords{});
    if constexpr ((count & 8) != 0) clear(std::uint64_t{});
    if constexpr ((count & 4) != 0) clear(std::uint32_t{});
    if constexpr ((count & 2) != 0) clear(std::uint16_t{});
    if constexpr ((count & 1) != 0) clear(std::uint8_t{});
}
// The lowest bits at these places, in their order.
[[gnu::always_inline]] inline std::uint64_t deposited(std::uint64_t bits, std::uint64_t places) {
#ifdef __BMI2__
    return __builtin_ia32_pdep_di(bits, places);
#else
    std::uint64_t all = 0;
    for (; places != 0; places &= places - 1, bits >>= 1)
        if (bits & 1) all |= places & -places;
    return all;
#endif
}

}  // namespace rddl::simd::inline RDDL_SIMD_LEVEL
