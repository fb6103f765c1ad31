// The vector registers of the processor that the compiler has been told to compile for.
//
// Four levels: AVX-512 (x86-64-v4), AVX2 (x86-64-v3), SSE2 (any x86-64), and 16-byte vectors as GCC
// and Clang make them anywhere else. Arithmetic is that of the compilers' vector types; this file
// adds only operations that they spell clumsily or translate badly. A mask is the bits of an
// unsigned number, lane 0 lowest. Everything lives in a namespace named after the level, so that
// objects compiled for different levels can be linked into one program.
//
// Over 400 lines: the same functions for each of the four levels, side by side.
#pragma once

#include <cstddef>
#include <cstdint>

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512BW__) && defined(__AVX512VL__)
#define RDDL_SIMD_AVX512
#define RDDL_SIMD_LEVEL avx512
#elif defined(__AVX2__)
#define RDDL_SIMD_LEVEL avx2
#elif defined(__SSE2__)
#define RDDL_SIMD_LEVEL sse2
#else
#define RDDL_SIMD_LEVEL portable
#endif

#if defined(__AVX2__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>  // alone, since the others take the compiler a quarter of a second
#endif

#include <cmath>
#include <type_traits>

// Registers that are filled lane by lane are zeroed first, since g++ warns of uninitialised values
// otherwise.
namespace rddl::simd::inline RDDL_SIMD_LEVEL {

// ------------------------------------------------------------------------------- registers

#ifdef RDDL_SIMD_AVX512
inline constexpr const char* level = "AVX-512";
inline constexpr int register_bytes = 64;
#elif defined(__AVX2__)
inline constexpr const char* level = "AVX2";
inline constexpr int register_bytes = 32;
#elif defined(__SSE2__)
inline constexpr const char* level = "SSE2";
inline constexpr int register_bytes = 16;
#else
inline constexpr const char* level = "portable";
inline constexpr int register_bytes = 16;
#endif

// Lanes of 64 bits in a register.
inline constexpr int lanes = register_bytes / 8;

template <class T>
struct VectorOf;
template <>
struct VectorOf<double> {
    typedef double type __attribute__((vector_size(register_bytes)));
};
template <>
struct VectorOf<float> {
    typedef float type __attribute__((vector_size(register_bytes)));
};
template <>
struct VectorOf<std::uint32_t> {
    typedef std::uint32_t type __attribute__((vector_size(register_bytes)));
};
template <>
struct VectorOf<std::int32_t> {
    typedef std::int32_t type __attribute__((vector_size(register_bytes)));
};
template <>
struct VectorOf<std::int64_t> {
    typedef std::int64_t type __attribute__((vector_size(register_bytes)));
};
template <>
struct VectorOf<std::uint64_t> {
    typedef std::uint64_t type __attribute__((vector_size(register_bytes)));
};
template <class T>
using Vector = typename VectorOf<T>::type;
template <class T>
struct HalfOf {
    typedef T type __attribute__((vector_size(register_bytes / 2)));
};

// Lanes of type T in a register.
template <class T>
inline constexpr int lanes_of = register_bytes / static_cast<int>(sizeof(T));

using Reals = Vector<double>;
using Floats = Vector<float>;
using Ints = Vector<std::int64_t>;
using Words = Vector<std::uint64_t>;

// The lowest bits count, as many as there are lanes.
using MaskBits = std::uint32_t;
template <class T>
inline constexpr MaskBits all_lanes_of = (1u << lanes_of<T>)-1;

// An unsigned number of n bits, or of 8: the mask of n lanes in several registers.
template <int n>
struct BitsOf;
template <>
struct BitsOf<4> {
    using type = std::uint8_t;
};
template <>
struct BitsOf<8> {
    using type = std::uint8_t;
};
template <>
struct BitsOf<16> {
    using type = std::uint16_t;
};
template <>
struct BitsOf<32> {
    using type = std::uint32_t;
};
template <>
struct BitsOf<64> {
    using type = std::uint64_t;
};

// The same bits as another type of lanes.
template <class To, class From>
[[gnu::always_inline]] inline To reinterpret(From a) {
    static_assert(sizeof(To) == sizeof(From));
    return (To)a;  // between vectors of one size, this is what such a cast means
}

// ----------------------------------------------------------------------------------- masks

#ifdef RDDL_SIMD_AVX512

[[gnu::always_inline]] inline MaskBits less(Reals a, Reals b) {
    return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ);
}
[[gnu::always_inline]] inline MaskBits less_equal(Reals a, Reals b) {
    return _mm512_cmp_pd_mask(a, b, _CMP_LE_OQ);
}
[[gnu::always_inline]] inline MaskBits equal(Reals a, Reals b) {
    return _mm512_cmp_pd_mask(a, b, _CMP_EQ_OQ);
}
[[gnu::always_inline]] inline MaskBits less(Floats a, Floats b) {
    return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ);
}
[[gnu::always_inline]] inline MaskBits less_equal(Floats a, Floats b) {
    return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ);
}
[[gnu::always_inline]] inline MaskBits equal(Floats a, Floats b) {
    return _mm512_cmp_ps_mask(a, b, _CMP_EQ_OQ);
}

namespace detail {

// Hides the comparison of ints behind a mask register. GCC 12 makes one instruction of comparing
// and widening such a mask, and splits it again as if only mask registers could hold the wide
// number: if one waits in memory, only its first byte is ever written. So GCC must not know that
// this is a comparison. It does not join comparisons of reals with anything.
[[gnu::always_inline]] inline __mmask8 hidden(__mmask8 mask) {
#ifndef __clang__
    asm("" : "+k"(mask));
#endif
    return mask;
}

}  // namespace detail

[[gnu::always_inline]] inline MaskBits less(Ints a, Ints b) {
    return detail::hidden(_mm512_cmp_epi64_mask((__m512i)a, (__m512i)b, _MM_CMPINT_LT));
}
[[gnu::always_inline]] inline MaskBits less_equal(Ints a, Ints b) {
    return detail::hidden(_mm512_cmp_epi64_mask((__m512i)a, (__m512i)b, _MM_CMPINT_LE));
}
[[gnu::always_inline]] inline MaskBits equal(Ints a, Ints b) {
    return detail::hidden(_mm512_cmp_epi64_mask((__m512i)a, (__m512i)b, _MM_CMPINT_EQ));
}

// The masks of neighbouring parts of `width` lanes each as one. They stay in mask registers, where
// that is one instruction.
template <int width>
[[gnu::always_inline]] inline std::uint64_t joined(std::uint64_t low, std::uint64_t high) {
    if constexpr (width == 8)
        return _mm512_kunpackb(static_cast<__mmask16>(high), static_cast<__mmask16>(low));
    if constexpr (width == 16)
        return _mm512_kunpackw(static_cast<__mmask32>(high), static_cast<__mmask32>(low));
    if constexpr (width == 32) return _mm512_kunpackd(high, low);
    return low | high << width;
}

// a where the bit is set, else b.
template <class V>
[[gnu::always_inline]] inline V blend(MaskBits mask, V a, V b) {
    return (V)_mm512_mask_blend_pd(static_cast<__mmask8>(mask), (__m512d)b, (__m512d)a);
}
[[gnu::always_inline]] inline Floats blend(MaskBits mask, Floats a, Floats b) {
    return _mm512_mask_blend_ps(static_cast<__mmask16>(mask), b, a);
}

#else

namespace detail {

// All ones where the bit is set, in lanes as wide as T.
template <class T>
[[gnu::always_inline]] inline Vector<T> spread(MaskBits mask) {
    Vector<T> bit_of_lane;
    for (int i = 0; i < lanes_of<T>; ++i) bit_of_lane[i] = T{1} << i;
    return (bit_of_lane & static_cast<T>(mask)) == bit_of_lane;
}

// Gathers the bits of lanes that are all ones or all zeros.
template <class V>
[[gnu::always_inline]] inline MaskBits gathered(V a) {
    constexpr int count = register_bytes / static_cast<int>(sizeof a[0]);
#if defined(__AVX2__)
    if constexpr (count == lanes)
        return static_cast<MaskBits>(_mm256_movemask_pd(reinterpret<__m256d>(a)));
    else
        return static_cast<MaskBits>(_mm256_movemask_ps(reinterpret<__m256>(a)));
#elif defined(__SSE2__)
    if constexpr (count == lanes)
        return static_cast<MaskBits>(_mm_movemask_pd(reinterpret<__m128d>(a)));
    else
        return static_cast<MaskBits>(_mm_movemask_ps(reinterpret<__m128>(a)));
#else
    MaskBits mask = 0;
    for (int i = 0; i < count; ++i) mask |= static_cast<MaskBits>(a[i] & 1) << i;
    return mask;
#endif
}

}  // namespace detail

template <int width>
[[gnu::always_inline]] inline std::uint64_t joined(std::uint64_t low, std::uint64_t high) {
    return low | high << width;
}

template <class V>
[[gnu::always_inline]] inline MaskBits less(V a, V b) {
    return detail::gathered(a < b);
}
template <class V>
[[gnu::always_inline]] inline MaskBits less_equal(V a, V b) {
    return detail::gathered(a <= b);
}
template <class V>
[[gnu::always_inline]] inline MaskBits equal(V a, V b) {
    return detail::gathered(a == b);
}
template <class V>
[[gnu::always_inline]] inline V blend(MaskBits mask, V a, V b) {
    return detail::spread<std::int64_t>(mask) ? a : b;
}
[[gnu::always_inline]] inline Floats blend(MaskBits mask, Floats a, Floats b) {
    return detail::spread<std::int32_t>(mask) ? a : b;
}

#endif

// ------------------------------------------------------------------------------ arithmetic

// Multiplies the lower 32 bits of each lane; all 64 bits of the products.
[[gnu::always_inline]] inline Words multiply_low_halves(Words a, Words b) {
#ifdef RDDL_SIMD_AVX512
    return (Words)_mm512_maskz_mul_epu32(0xFF, (__m512i)a, (__m512i)b);
#elif defined(__AVX2__)
    return (Words)_mm256_mul_epu32((__m256i)a, (__m256i)b);
#elif defined(__SSE2__)
    return (Words)_mm_mul_epu32((__m128i)a, (__m128i)b);
#else
    return (a & 0xFFFFFFFFu) * (b & 0xFFFFFFFFu);
#endif
}

// Moves the upper 32 bits of each lane to the lower ones; the upper bits are arbitrary then.
[[gnu::always_inline]] inline Words upper_halves(Words a) {
#ifdef RDDL_SIMD_AVX512
    // A shuffle replaces the shift, since one execution port does all shifts and also the products.
    return (Words)_mm512_maskz_shuffle_epi32(0xFFFF, (__m512i)a, static_cast<_MM_PERM_ENUM>(0xF5));
#else
    return a >> 32;
#endif
}
// The lower 32 bits of two.
[[gnu::always_inline]] inline Words join_lower_halves(Words low, Words high) {
#ifdef RDDL_SIMD_AVX512
    return (Words)_mm512_mask_shuffle_epi32((__m512i)low, 0xAAAA, (__m512i)high,
                                            static_cast<_MM_PERM_ENUM>(0xA0));
#else
    return (low & 0xFFFFFFFF) | high << 32;
#endif
}

// Exactly rounded.
[[gnu::always_inline]] inline Reals square_root(Reals a) {
#ifdef RDDL_SIMD_AVX512
    return _mm512_maskz_sqrt_pd(0xFF, a);
#elif defined(__AVX2__)
    return _mm256_sqrt_pd(a);
#elif defined(__SSE2__)
    return _mm_sqrt_pd(a);
#else
    for (int i = 0; i < lanes; ++i) a[i] = std::sqrt(a[i]);
    return a;
#endif
}

[[gnu::always_inline]] inline Floats square_root(Floats a) {
#ifdef RDDL_SIMD_AVX512
    return _mm512_maskz_sqrt_ps(0xFFFF, a);
#elif defined(__AVX2__)
    return _mm256_sqrt_ps(a);
#elif defined(__SSE2__)
    return _mm_sqrt_ps(a);
#else
    for (int i = 0; i < lanes_of<float>; ++i) a[i] = std::sqrt(a[i]);
    return a;
#endif
}

// Rounded to nearest, halves to even, for every int.
[[gnu::always_inline]] inline Reals to_reals(Ints a) {
#ifdef RDDL_SIMD_AVX512
    return _mm512_maskz_cvtepi64_pd(0xFF, (__m512i)a);
#else
    // The halves as mantissas of 2^84 and of 2^52; the sum that puts them together rounds, once.
    const Words bits = reinterpret<Words>(a);
    const Words high = (bits >> 32) ^ 0x4530000080000000;
    const Words low = (bits & 0xFFFFFFFF) | 0x4330000000000000;
    constexpr double both_offsets = 0x1p84 + 0x1p63 + 0x1p52;
    return (reinterpret<Reals>(high) - both_offsets) + reinterpret<Reals>(low);
#endif
}

namespace detail {

// Rounds by one of the rounding modes of SSE4.1 and AVX-512.
template <int mode, class Function>
[[gnu::always_inline]] inline Reals rounded(Reals a, [[maybe_unused]] Function function) {
#if defined(RDDL_SIMD_AVX512)
    return _mm512_maskz_roundscale_pd(0xFF, a, mode);
#elif defined(__AVX2__)
    return _mm256_round_pd(a, mode);
#else
    for (int i = 0; i < lanes; ++i) a[i] = function(a[i]);
    return a;
#endif
}

}  // namespace detail

// To whole numbers; halves go to the even neighbour.
[[gnu::always_inline]] inline Reals nearest(Reals a) {
    return detail::rounded<0x8>(a, [](double x) { return std::nearbyint(x); });
}
[[gnu::always_inline]] inline Reals floor(Reals a) {
    return detail::rounded<0x9>(a, [](double x) { return std::floor(x); });
}
[[gnu::always_inline]] inline Reals ceil(Reals a) {
    return detail::rounded<0xA>(a, [](double x) { return std::ceil(x); });
}

// Toward zero; nan and what int cannot hold give the least int.
[[gnu::always_inline]] inline Ints truncate(Reals a) {
#ifdef RDDL_SIMD_AVX512
    return (Ints)_mm512_maskz_cvttpd_epi64(0xFF, a);
#else
    Ints result{};
    for (int i = 0; i < lanes; ++i) {
        const bool holds = a[i] >= -0x1p63 && a[i] < 0x1p63;
        result[i] = holds ? static_cast<std::int64_t>(a[i]) : INT64_MIN;
    }
    return result;
#endif
}

// Interleaves the first halves of a and b, or the second ones, lane by lane.
[[gnu::always_inline]] inline Words interleave_half(Words a, Words b, int half) {
#if defined(RDDL_SIMD_AVX512)
    const Words first = {0, 8, 1, 9, 2, 10, 3, 11};
    const auto lanes_to_take = (__m512i)(half == 0 ? first : first + 4);
    return (Words)_mm512_maskz_permutex2var_epi64(0xFF, (__m512i)a, lanes_to_take, (__m512i)b);
#elif defined(__AVX2__)
    const __m256i even = _mm256_unpacklo_epi64((__m256i)a, (__m256i)b);
    const __m256i odd = _mm256_unpackhi_epi64((__m256i)a, (__m256i)b);
    return (Words)(half == 0 ? _mm256_permute2x128_si256(even, odd, 0x20)
                             : _mm256_permute2x128_si256(even, odd, 0x31));
#else
    static_assert(lanes == 2);
    return half == 0 ? Words{a[0], b[0]} : Words{a[1], b[1]};
#endif
}

// ------------------------------------------------------------------------------------- bits

// The bits that leave a lane at its upper end enter it at the lower one.
[[gnu::always_inline]] inline Ints rotate_left(Ints a, Ints count) {
#ifdef RDDL_SIMD_AVX512
    return (Ints)_mm512_maskz_rolv_epi64(0xFF, (__m512i)a, (__m512i)count);
#else
    const Words bits = (Words)a;
    return (Ints)(bits << (Words)count | bits >> (Words)(-count & 63));
#endif
}

// How many bits of each lane are 1: a table for 4 bits where registers can look up bytes (W. Mula,
// N. Kurz, D. Lemire, Faster Population Counts Using AVX2 Instructions, 2018), else sums of
// neighbours (H. Warren, Hacker's Delight, section 5-1).
[[gnu::always_inline]] inline Ints count_ones(Ints a) {
#if defined(RDDL_SIMD_AVX512) && defined(__AVX512VPOPCNTDQ__)
    return (Ints)_mm512_maskz_popcnt_epi64(0xFF, (__m512i)a);
#elif defined(__AVX2__)
    constexpr std::int64_t counts_of_0_to_7 = 0x0302020102010100;
    constexpr std::int64_t counts_of_8_to_15 = 0x0403030203020201;
    const Ints low_bits = a & 0x0F0F0F0F0F0F0F0F;
    const Ints high_bits = a >> 4 & 0x0F0F0F0F0F0F0F0F;
#ifdef RDDL_SIMD_AVX512
    constexpr __mmask64 all = ~std::uint64_t{0};
    const __m512i counts =
        (__m512i)Ints{counts_of_0_to_7, counts_of_8_to_15, counts_of_0_to_7, counts_of_8_to_15,
                      counts_of_0_to_7, counts_of_8_to_15, counts_of_0_to_7, counts_of_8_to_15};
    const __m512i low = _mm512_maskz_shuffle_epi8(all, counts, (__m512i)low_bits);
    const __m512i high = _mm512_maskz_shuffle_epi8(all, counts, (__m512i)high_bits);
    return (Ints)_mm512_sad_epu8(_mm512_maskz_add_epi8(all, low, high), __m512i{});
#else
    const __m256i counts =
        (__m256i)Ints{counts_of_0_to_7, counts_of_8_to_15, counts_of_0_to_7, counts_of_8_to_15};
    const __m256i low = _mm256_shuffle_epi8(counts, (__m256i)low_bits);
    const __m256i high = _mm256_shuffle_epi8(counts, (__m256i)high_bits);
    return (Ints)_mm256_sad_epu8(_mm256_add_epi8(low, high), __m256i{});
#endif
#else
    Words bits = reinterpret<Words>(a);
    bits -= bits >> 1 & 0x5555555555555555;
    bits = (bits & 0x3333333333333333) + (bits >> 2 & 0x3333333333333333);
    bits = (bits + (bits >> 4)) & 0x0F0F0F0F0F0F0F0F;
    bits += bits >> 8;
    bits += bits >> 16;
    bits += bits >> 32;
    return reinterpret<Ints>(bits & 0x7F);
#endif
}

// 8 bytes of 0 or 1 as 8 bits, and back; byte i is bit i.
constexpr std::uint64_t bits_of_bytes(std::uint64_t bytes) {
    return bytes * 0x0102040810204080 >> 56;
}
constexpr std::uint64_t bytes_of_bits(std::uint64_t bits) {
    const std::uint64_t selected = bits * 0x0101010101010101 & 0x8040201008040201;
    return (selected + 0x7F7F7F7F7F7F7F7F) >> 7 & 0x0101010101010101;
}

typedef std::uint64_t TwoWords __attribute__((vector_size(16)));

#ifdef __SSE2__
// 0 < `count` <= 16 bytes, in the largest parts of 16, 8, 4, 2 and 1; zeros behind them.
[[gnu::always_inline]] inline __m128i load_parts(const void* bytes, int count) {
    if (count == 16) return _mm_loadu_si128(static_cast<const __m128i_u*>(bytes));
    TwoWords words{};
    int i = 0;
    const auto load = [&](auto part) __attribute__((always_inline)) {
        if ((count & static_cast<int>(sizeof part)) == 0) return;
        __builtin_memcpy(&part, static_cast<const char*>(bytes) + i, sizeof part);
        words[i / 8] |= std::uint64_t{part} << i % 8 * 8;
        i += static_cast<int>(sizeof part);
    };
    load(std::uint64_t{});
    load(std::uint32_t{});
    load(std::uint16_t{});
    load(std::uint8_t{});
    return (__m128i)words;
}
[[gnu::always_inline]] inline void store_parts(void* bytes, __m128i values, int count) {
    if (count == 16) return _mm_storeu_si128(static_cast<__m128i_u*>(bytes), values);
    int i = 0;
    const auto store = [&](auto part) __attribute__((always_inline)) {
        if ((count & static_cast<int>(sizeof part)) == 0) return;
        part = static_cast<decltype(part)>(((TwoWords)values)[i / 8] >> i % 8 * 8);
        __builtin_memcpy(static_cast<char*>(bytes) + i, &part, sizeof part);
        i += static_cast<int>(sizeof part);
    };
    store(std::uint64_t{});
    store(std::uint32_t{});
    store(std::uint16_t{});
    store(std::uint8_t{});
}
#endif
#ifdef RDDL_SIMD_AVX512
// 0 < `count` <= 64 bytes in such parts, with any values behind them.
[[gnu::always_inline]] inline __m512i load_many_parts(const void* bytes, int count) {
    const auto part = [&](int i) __attribute__((always_inline)) {
        const int rest = count - i;
        if (rest <= 0) return __m128i{};
        return load_parts(static_cast<const char*>(bytes) + i, rest < 16 ? rest : 16);
    };
    if (count <= 16) return _mm512_castsi128_si512(part(0));
    const auto half = [&](int i) __attribute__((always_inline)) {
        return _mm256_inserti128_si256(_mm256_castsi128_si256(part(i)), part(i + 16), 1);
    };
    const __m512i first = _mm512_maskz_inserti64x4(0xF, __m512i{}, half(0), 0);
    return count <= 32 ? first : _mm512_maskz_inserti64x4(0xFF, first, half(32), 1);
}
[[gnu::always_inline]] inline void store_many_parts(void* bytes, std::uint64_t bits, int count) {
    if (count == 64) return _mm512_storeu_si512(bytes, _mm512_maskz_set1_epi8(bits, 1));
#pragma GCC unroll 4
    for (int i = 0; i < count; i += 16)
        store_parts(static_cast<char*>(bytes) + i,
                    _mm_maskz_set1_epi8(static_cast<__mmask16>(bits >> i), 1),
                    count - i < 16 ? count - i : 16);
}
#elif defined(__AVX2__)
// A bit for each byte that is not 0; and the bytes of 0 and 1 for such bits.
[[gnu::always_inline]] inline std::uint64_t nonzero_bits(__m128i bytes) {
    const int zero = _mm_movemask_epi8(_mm_cmpeq_epi8(bytes, _mm_setzero_si128()));
    return static_cast<std::uint64_t>(zero ^ 0xFFFF);
}
[[gnu::always_inline]] inline std::uint64_t nonzero_bits(__m256i bytes) {
    const int zero = _mm256_movemask_epi8(_mm256_cmpeq_epi8(bytes, _mm256_setzero_si256()));
    return std::uint64_t{~static_cast<std::uint32_t>(zero)};
}
[[gnu::always_inline]] inline __m128i bytes_of_few_bits(std::uint64_t bits) {
    const __m128i own_bit = _mm_set1_epi64x(static_cast<std::int64_t>(0x8040201008040201));
    const __m128i own_byte = _mm_set_epi64x(0x0101010101010101, 0);
    const __m128i all = _mm_set1_epi16(static_cast<std::int16_t>(bits));
    const __m128i own = _mm_and_si128(_mm_shuffle_epi8(all, own_byte), own_bit);
    return _mm_and_si128(_mm_cmpeq_epi8(own, own_bit), _mm_set1_epi8(1));
}
[[gnu::always_inline]] inline __m256i bytes_of_many_bits(std::uint64_t bits) {
    const __m256i own_bit = _mm256_set1_epi64x(static_cast<std::int64_t>(0x8040201008040201));
    const __m256i own_byte =
        _mm256_set_epi64x(0x0303030303030303, 0x0202020202020202, 0x0101010101010101, 0);
    const __m256i all = _mm256_set1_epi32(static_cast<std::int32_t>(bits));
    const __m256i own = _mm256_and_si256(_mm256_shuffle_epi8(all, own_byte), own_bit);
    return _mm256_and_si256(_mm256_cmpeq_epi8(own, own_bit), _mm256_set1_epi8(1));
}
#endif

// A bit for each of 0 < `count` <= 64 bytes that is not 0.
[[gnu::always_inline]] inline std::uint64_t bits_of_bytes(const void* bytes, int count) {
#ifdef RDDL_SIMD_AVX512
    const __m512i values = _mm512_maskz_loadu_epi8(~std::uint64_t{0} >> (64 - count), bytes);
    return _mm512_test_epi8_mask(values, values);
#else
    constexpr std::uint64_t low_bits = 0x7F7F7F7F7F7F7F7F, ones = 0x0101010101010101;
    std::uint64_t bits = 0;
    int i = 0;
#ifdef __AVX2__
    for (; i + 16 <= count; i += 16)
        bits |= nonzero_bits(load_parts(static_cast<const char*>(bytes) + i, 16)) << i;
    // By way of a word, the last ones would be loaded from the stack.
    if (__builtin_constant_p(count) && i < count)
        return bits | nonzero_bits(load_parts(static_cast<const char*>(bytes) + i, count - i)) << i;
#endif
    for (; i < count; i += 8) {
        std::uint64_t chunk = 0;
        __builtin_memcpy(&chunk, static_cast<const char*>(bytes) + i,
                         i + 8 < count ? 8 : count - i);
        const std::uint64_t not_zero = ((chunk & low_bits) + low_bits) | chunk;
        bits |= bits_of_bytes(not_zero >> 7 & ones) << i;
    }
    return bits;
#endif
}
// The same of bytes that store_as_bytes may have stored just now: processors are slow to load what
// was stored in other parts, so these are the same.
[[gnu::always_inline]] inline std::uint64_t bits_of_stored_bytes(const void* bytes, int count) {
#ifdef RDDL_SIMD_AVX512
    if (__builtin_constant_p(count)) {
        std::uint64_t bits = 0;
#pragma GCC unroll 4
        for (int i = 0; i < count; i += 16) {
            const __m128i values =
                load_parts(static_cast<const char*>(bytes) + i, count - i < 16 ? count - i : 16);
            bits |= std::uint64_t{_mm_test_epi8_mask(values, values)} << i;
        }
        return bits;
    }
#endif
    return bits_of_bytes(bytes, count);
}
// The first `count` > 0 of the n bits.
template <int n>
[[gnu::always_inline]] inline void store_as_bytes(std::uint64_t bits, void* bytes, int count) {
#ifdef RDDL_SIMD_AVX512
    if (n <= 16 && __builtin_constant_p(count))
        return store_parts(bytes, _mm_maskz_set1_epi8(static_cast<__mmask16>(bits), 1), count);
    if (n == 64 && __builtin_constant_p(count)) return store_many_parts(bytes, bits, count);
    const std::uint64_t stored = ~std::uint64_t{0} >> (64 - count);
    if constexpr (n <= 16)
        _mm_mask_storeu_epi8(bytes, static_cast<__mmask16>(stored),
                             _mm_maskz_set1_epi8(static_cast<__mmask16>(bits), 1));
    else
        _mm512_mask_storeu_epi8(bytes, stored, _mm512_maskz_set1_epi8(bits, 1));
#else
    int i = 0;
#ifdef __AVX2__
    for (; i + 16 <= count; i += 16)
        store_parts(static_cast<char*>(bytes) + i, bytes_of_few_bits(bits >> i), 16);
    if (__builtin_constant_p(count) && i < count)
        return store_parts(static_cast<char*>(bytes) + i, bytes_of_few_bits(bits >> i), count - i);
#endif
    for (; i < count; i += 8) {
        const std::uint64_t chunk = bytes_of_bits(bits >> i & 0xFF);
        __builtin_memcpy(static_cast<char*>(bytes) + i, &chunk, count - i < 8 ? count - i : 8);
    }
#endif
}

}  // namespace rddl::simd::inline RDDL_SIMD_LEVEL
