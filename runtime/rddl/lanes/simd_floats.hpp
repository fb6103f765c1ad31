// Lanes of 32 bits (simd.hpp): from and to lanes of 64 bits, and in half a register.
//
// A register holds twice as many floats as doubles or ints. So 8 floats fill half a register of
// AVX-512, for which processors have instructions.
#pragma once

#include <rddl/lanes/simd.hpp>
#include <rddl/lanes/simd_moves.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace rddl::simd::inline RDDL_SIMD_LEVEL {

// The vector type of n lanes: a register, or half a register.
template <class T, int n, bool fill_registers = (n >= lanes_of<T>)>
struct VectorsFor {
    using type = Vector<T>;
};
template <class T, int n>
struct VectorsFor<T, n, false> {
    static_assert(2 * n == lanes_of<T>);
    using type = typename HalfOf<T>::type;
};

using HalfFloats = typename HalfOf<float>::type;

// ------------------------------------------------------------------------------ conversions

// By hand, since compilers join and part registers in memory, which then waits for its stores.
#ifdef RDDL_SIMD_AVX512

[[gnu::always_inline]] inline HalfFloats half_of(Floats a, int half) {
    if (half == 1) return _mm512_maskz_extractf32x8_ps(0xFF, a, 1);
    return __builtin_shufflevector(a, a, 0, 1, 2, 3, 4, 5, 6, 7);
}
[[gnu::always_inline]] inline Floats joined(HalfFloats first, HalfFloats second) {
    return _mm512_maskz_insertf32x8(0xFFFF, _mm512_castps256_ps512(first), second, 1);
}
[[gnu::always_inline]] inline Reals to_reals(HalfFloats a) {
    return _mm512_maskz_cvtps_pd(0xFF, a);
}
[[gnu::always_inline]] inline HalfFloats to_floats(Reals a) {
    return _mm512_maskz_cvtpd_ps(0xFF, a);
}
[[gnu::always_inline]] inline HalfFloats to_floats(Ints a) {
    return _mm512_maskz_cvtepi64_ps(0xFF, (__m512i)a);
}

#else

namespace detail {

template <class V, std::size_t... lane>
[[gnu::always_inline]] inline auto lanes_from(V a, int first, std::index_sequence<lane...>) {
    using T = std::remove_cvref_t<decltype(a[0])>;
    return typename HalfOf<T>::type{a[first + static_cast<int>(lane)]...};
}
template <class V, std::size_t... lane>
[[gnu::always_inline]] inline auto joined(V first, V second, std::index_sequence<lane...>) {
    using T = std::remove_cvref_t<decltype(first[0])>;
    const Vector<T> both = __builtin_shufflevector(first, second, lane...);
    return both;
}

}  // namespace detail

[[gnu::always_inline]] inline HalfFloats half_of(Floats a, int half) {
    return detail::lanes_from(a, half * lanes, std::make_index_sequence<lanes>());
}
template <class V>
[[gnu::always_inline]] inline auto joined(V first, V second) {
    return detail::joined(first, second, std::make_index_sequence<2 * lanes>());
}
[[gnu::always_inline]] inline Reals to_reals(HalfFloats a) {
    return __builtin_convertvector(a, Reals);
}
template <class V>
[[gnu::always_inline]] inline HalfFloats to_floats(V a) {
    return __builtin_convertvector(a, HalfFloats);
}

#endif

// The lower 32 bits of each lane.
[[gnu::always_inline]] inline typename HalfOf<std::uint32_t>::type lower_halves(Words a) {
#ifdef RDDL_SIMD_AVX512
    return (typename HalfOf<std::uint32_t>::type)_mm512_maskz_cvtepi64_epi32(0xFF, (__m512i)a);
#else
    return __builtin_convertvector(a, typename HalfOf<std::uint32_t>::type);
#endif
}
[[gnu::always_inline]] inline Vector<std::uint32_t> lower_halves(Words first, Words second) {
#ifdef RDDL_SIMD_AVX512
    const Vector<std::uint32_t> even = {0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30};
    return (Vector<std::uint32_t>)_mm512_maskz_permutex2var_epi32(0xFFFF, (__m512i)first,
                                                                  (__m512i)even, (__m512i)second);
#else
    return joined(lower_halves(first), lower_halves(second));
#endif
}

// Toward zero; nan and what int cannot hold give the least int.
[[gnu::always_inline]] inline Ints truncate(HalfFloats a) {
#ifdef RDDL_SIMD_AVX512
    return (Ints)_mm512_maskz_cvttps_epi64(0xFF, a);
#else
    return truncate(to_reals(a));
#endif
}

namespace detail {

// Rounds by one of the rounding modes of SSE4.1 and AVX-512.
template <int mode, class Function>
[[gnu::always_inline]] inline Floats rounded(Floats a, [[maybe_unused]] Function function) {
#if defined(RDDL_SIMD_AVX512)
    return _mm512_maskz_roundscale_ps(0xFFFF, a, mode);
#elif defined(__AVX2__)
    return _mm256_round_ps(a, mode);
#else
    for (int i = 0; i < lanes_of<float>; ++i) a[i] = function(a[i]);
    return a;
#endif
}

}  // namespace detail

// To whole numbers; halves go to the even neighbour.
[[gnu::always_inline]] inline Floats nearest(Floats a) {
    return detail::rounded<0x8>(a, [](float x) { return std::nearbyint(x); });
}
[[gnu::always_inline]] inline Floats floor(Floats a) {
    return detail::rounded<0x9>(a, [](float x) { return std::floor(x); });
}
[[gnu::always_inline]] inline Floats ceil(Floats a) {
    return detail::rounded<0xA>(a, [](float x) { return std::ceil(x); });
}

// a where the last bit of the lane is 0, else b.
template <class Bits, class V>
[[gnu::always_inline]] inline V first_if_even(Bits bits, V a, V b) {
#ifdef RDDL_SIMD_AVX512
    if constexpr (sizeof(Bits) < register_bytes)
        return _mm256_mask_blend_ps(
            _mm256_test_epi32_mask(reinterpret<__m256i>(bits), _mm256_set1_epi32(1)), a, b);
    else if constexpr (sizeof bits[0] == 4)
        return _mm512_mask_blend_ps(
            _mm512_test_epi32_mask(reinterpret<__m512i>(bits), _mm512_set1_epi32(1)), a, b);
    else
        return _mm512_mask_blend_pd(
            _mm512_test_epi64_mask(reinterpret<__m512i>(bits), _mm512_set1_epi64(1)), a, b);
#else
    const Bits odd = Bits{} - (bits & 1);
    const Bits first = reinterpret<Bits>(a);
    return reinterpret<V>(first ^ ((first ^ reinterpret<Bits>(b)) & odd));
#endif
}

// ------------------------------------------------------------------------- half a register

#ifdef RDDL_SIMD_AVX512

[[gnu::always_inline]] inline MaskBits less(HalfFloats a, HalfFloats b) {
    return _mm256_cmp_ps_mask(a, b, _CMP_LT_OQ);
}
[[gnu::always_inline]] inline MaskBits less_equal(HalfFloats a, HalfFloats b) {
    return _mm256_cmp_ps_mask(a, b, _CMP_LE_OQ);
}
[[gnu::always_inline]] inline MaskBits equal(HalfFloats a, HalfFloats b) {
    return _mm256_cmp_ps_mask(a, b, _CMP_EQ_OQ);
}
[[gnu::always_inline]] inline HalfFloats blend(MaskBits mask, HalfFloats a, HalfFloats b) {
    return _mm256_mask_blend_ps(static_cast<__mmask8>(mask), b, a);
}
[[gnu::always_inline]] inline HalfFloats square_root(HalfFloats a) {
    return _mm256_sqrt_ps(a);
}
[[gnu::always_inline]] inline HalfFloats nearest(HalfFloats a) {
    return _mm256_round_ps(a, 0x8);
}
[[gnu::always_inline]] inline HalfFloats floor(HalfFloats a) {
    return _mm256_round_ps(a, 0x9);
}
[[gnu::always_inline]] inline HalfFloats ceil(HalfFloats a) {
    return _mm256_round_ps(a, 0xA);
}

[[gnu::always_inline]] inline HalfFloats gather(const float* from, Ints indices) {
    return _mm512_mask_i64gather_ps(__m256{}, 0xFF, (__m512i)indices, from, 4);
}
template <std::int64_t count>
[[gnu::always_inline]] inline HalfFloats look_up(const float* table, Ints indices) {
    if constexpr (count <= 32) return half_of(look_up<count>(table, indices, indices), 0);
    return gather(table, indices);
}

#endif

// The first `count` lanes, zeros in the others, as load_some and store_some do.
[[gnu::always_inline]] inline HalfFloats load_some_of_half(const float* from, int count) {
#ifdef RDDL_SIMD_AVX512
    const std::uint32_t some = _bzhi_u32(0xFF, static_cast<unsigned>(count));
    return _mm256_maskz_loadu_ps(static_cast<__mmask8>(some), from);
#else
    HalfFloats result{};
    for (int i = 0; i < lanes && i < count; ++i) result[i] = from[i];
    return result;
#endif
}
[[gnu::always_inline]] inline void store_some_of_half(float* to, HalfFloats values, int count) {
#ifdef RDDL_SIMD_AVX512
    const std::uint32_t some = _bzhi_u32(0xFF, static_cast<unsigned>(count));
    _mm256_mask_storeu_ps(to, static_cast<__mmask8>(some), values);
#else
    for (int i = 0; i < lanes && i < count; ++i) to[i] = values[i];
#endif
}
// See load_in_pairs and store_one_by_one of doubles (simd_halves.hpp).
[[gnu::always_inline]] inline HalfFloats load_one_by_one(const float* from, int count) {
#ifdef RDDL_SIMD_AVX512
    const __m128 first = _mm_unpacklo_ps(_mm_load_ss(from), _mm_load_ss(from + 1));
    __m128 second{};
    if (count > 2) second = _mm_load_ss(from + 2);
    if (count > 3) second = _mm_unpacklo_ps(second, _mm_load_ss(from + 3));
    return _mm256_zextps128_ps256(_mm_movelh_ps(first, second));
#else
    return load_some_of_half(from, count);
#endif
}
[[gnu::always_inline]] inline void store_one_by_one(float* to, HalfFloats values, int count) {
    for (int i = 0; i < most_in_pairs && i < count; ++i) to[i] = values[i];
}

}  // namespace rddl::simd::inline RDDL_SIMD_LEVEL
