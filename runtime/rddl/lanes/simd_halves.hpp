// Four lanes of 64 bits in half a register of AVX-512 (simd.hpp). Elsewhere they fill registers.
//
// Processors divide twice as many halves in the same time, and have more units for them. What is
// rare is done in a whole register, whose other lanes are zero.
#pragma once

#include <rddl/lanes/simd.hpp>
#include <rddl/lanes/simd_moves.hpp>

#include <cstdint>

namespace rddl::simd::inline RDDL_SIMD_LEVEL {

#ifdef RDDL_SIMD_AVX512

using HalfReals = typename HalfOf<double>::type;
using HalfInts = typename HalfOf<std::int64_t>::type;
using HalfWords = typename HalfOf<std::uint64_t>::type;

// ------------------------------------------------------------------- from and to registers

[[gnu::always_inline]] inline Reals in_register(HalfReals a) {
    return _mm512_maskz_insertf64x4(0xFF, Reals{}, a, 0);
}
[[gnu::always_inline]] inline Ints in_register(HalfInts a) {
    return (Ints)_mm512_maskz_inserti64x4(0xFF, __m512i{}, (__m256i)a, 0);
}
template <class T>
[[gnu::always_inline]] inline auto first_half(T a) {
    return __builtin_shufflevector(a, a, 0, 1, 2, 3);
}
[[gnu::always_inline]] inline HalfReals half_of(Reals a, int half) {
    return half == 0 ? first_half(a) : (HalfReals)_mm512_maskz_extractf64x4_pd(0xF, a, 1);
}

// ----------------------------------------------------------------------------------- masks

[[gnu::always_inline]] inline MaskBits less(HalfReals a, HalfReals b) {
    return _mm256_cmp_pd_mask(a, b, _CMP_LT_OQ);
}
[[gnu::always_inline]] inline MaskBits less_equal(HalfReals a, HalfReals b) {
    return _mm256_cmp_pd_mask(a, b, _CMP_LE_OQ);
}
[[gnu::always_inline]] inline MaskBits equal(HalfReals a, HalfReals b) {
    return _mm256_cmp_pd_mask(a, b, _CMP_EQ_OQ);
}
[[gnu::always_inline]] inline MaskBits less(HalfInts a, HalfInts b) {
    return detail::hidden(_mm256_cmp_epi64_mask((__m256i)a, (__m256i)b, _MM_CMPINT_LT));
}
[[gnu::always_inline]] inline MaskBits less_equal(HalfInts a, HalfInts b) {
    return detail::hidden(_mm256_cmp_epi64_mask((__m256i)a, (__m256i)b, _MM_CMPINT_LE));
}
[[gnu::always_inline]] inline MaskBits equal(HalfInts a, HalfInts b) {
    return detail::hidden(_mm256_cmp_epi64_mask((__m256i)a, (__m256i)b, _MM_CMPINT_EQ));
}

[[gnu::always_inline]] inline HalfReals blend(MaskBits mask, HalfReals a, HalfReals b) {
    return _mm256_mask_blend_pd(static_cast<__mmask8>(mask), b, a);
}
[[gnu::always_inline]] inline HalfInts blend(MaskBits mask, HalfInts a, HalfInts b) {
    return (HalfInts)_mm256_mask_blend_epi64(static_cast<__mmask8>(mask), (__m256i)b, (__m256i)a);
}
[[gnu::always_inline]] inline HalfWords blend(MaskBits mask, HalfWords a, HalfWords b) {
    return (HalfWords)_mm256_mask_blend_epi64(static_cast<__mmask8>(mask), (__m256i)b, (__m256i)a);
}
// a where the last bit of the lane is 0, else b.
[[gnu::always_inline]] inline HalfReals first_if_even(HalfWords bits, HalfReals a, HalfReals b) {
    return _mm256_mask_blend_pd(_mm256_test_epi64_mask((__m256i)bits, _mm256_set1_epi64x(1)), a, b);
}

// ------------------------------------------------------------------------------ arithmetic

[[gnu::always_inline]] inline HalfReals square_root(HalfReals a) {
    return _mm256_sqrt_pd(a);
}
[[gnu::always_inline]] inline HalfReals nearest(HalfReals a) {
    return _mm256_round_pd(a, 0x8);
}
[[gnu::always_inline]] inline HalfReals floor(HalfReals a) {
    return _mm256_round_pd(a, 0x9);
}
[[gnu::always_inline]] inline HalfReals ceil(HalfReals a) {
    return _mm256_round_pd(a, 0xA);
}
[[gnu::always_inline]] inline HalfReals to_reals(HalfInts a) {
    return _mm256_maskz_cvtepi64_pd(0xF, (__m256i)a);
}
[[gnu::always_inline]] inline HalfInts truncate(HalfReals a) {
    return (HalfInts)_mm256_maskz_cvttpd_epi64(0xF, a);
}
[[gnu::always_inline]] inline HalfInts rotate_left(HalfInts a, HalfInts count) {
    return (HalfInts)_mm256_maskz_rolv_epi64(0xF, (__m256i)a, (__m256i)count);
}
[[gnu::always_inline]] inline HalfInts count_ones(HalfInts a) {
    return first_half(count_ones(in_register(a)));
}

// ------------------------------------------------------------------------- loads and stores

// The first `count` lanes, 1 to 4; zeros in the others, as load_some and store_some do.
[[gnu::always_inline]] inline HalfReals load_some_of_half(const double* from, int count) {
    const std::uint32_t some = _bzhi_u32(0xF, static_cast<unsigned>(count));
    return _mm256_maskz_loadu_pd(static_cast<__mmask8>(some), from);
}
[[gnu::always_inline]] inline HalfInts load_some_of_half(const std::int64_t* from, int count) {
    return (HalfInts)load_some_of_half(reinterpret_cast<const double*>(from), count);
}
[[gnu::always_inline]] inline void store_some_of_half(double* to, HalfReals values, int count) {
    const std::uint32_t some = _bzhi_u32(0xF, static_cast<unsigned>(count));
    _mm256_mask_storeu_pd(to, static_cast<__mmask8>(some), values);
}
[[gnu::always_inline]] inline void store_some_of_half(std::int64_t* to, HalfInts values,
                                                      int count) {
    store_some_of_half(reinterpret_cast<double*>(to), (HalfReals)values, count);
}
// The same of 2 to 4 values, which may have been stored one by one just now: where a load of all of
// them waits until memory has them, loads of pairs take them from the stores. Loads take single
// values and pairs from these stores.
[[gnu::always_inline]] inline HalfReals load_one_by_one(const double* from, int count) {
    const __m128d first = _mm_loadh_pd(_mm_load_sd(from), from + 1);
    __m128d second{};
    if (count > 2) second = _mm_load_sd(from + 2);
    if (count > 3) second = _mm_loadh_pd(second, from + 3);
    return _mm256_insertf128_pd(_mm256_zextpd128_pd256(first), second, 1);
}
[[gnu::always_inline]] inline HalfInts load_one_by_one(const std::int64_t* from, int count) {
    return (HalfInts)load_one_by_one(reinterpret_cast<const double*>(from), count);
}
[[gnu::always_inline]] inline void store_one_by_one(double* to, HalfReals values, int count) {
    const __m128d first = _mm256_castpd256_pd128(values), second = _mm256_extractf128_pd(values, 1);
    if (count == 1) return _mm_store_sd(to, first);
    _mm_storeu_pd(to, first);
    if (count == 3) _mm_store_sd(to + 2, second);
    if (count == 4) _mm_storeu_pd(to + 2, second);
}
[[gnu::always_inline]] inline void store_one_by_one(std::int64_t* to, HalfInts values, int count) {
    store_one_by_one(reinterpret_cast<double*>(to), (HalfReals)values, count);
}

[[gnu::always_inline]] inline HalfReals gather(const double* from, HalfInts indices) {
    return _mm256_mmask_i64gather_pd(HalfReals{}, 0xF, (__m256i)indices, from, 8);
}
// Gathering four lanes takes no longer than looking up in two registers.
template <std::int64_t count>
[[gnu::always_inline]] inline HalfReals look_up(const double* table, HalfInts indices) {
    if constexpr (count <= 8) return first_half(look_up<count>(table, in_register(indices)));
    return gather(table, indices);
}
template <std::int64_t size>
[[gnu::always_inline]] inline HalfWords gather_bytes(const void* from, HalfInts offsets) {
    return first_half(gather_bytes<size>(from, in_register(offsets)));
}

// ------------------------------------------------------------------------ some of the lanes

[[gnu::always_inline]] inline void compress(std::uint64_t mask, const HalfReals (&from)[1],
                                            double others, double (&to)[8]) {
    const Reals whole[1] = {in_register(from[0])};
    compress(mask, whole, others, to);
}
[[gnu::always_inline]] inline void expand(std::uint64_t mask, const double (&from)[8],
                                          HalfReals (&to)[1]) {
    Reals whole[1] = {in_register(to[0])};
    expand(mask, from, whole);
    to[0] = first_half(whole[0]);
}

#endif

// ------------------------------------------------------------- few lanes of a whole register

[[gnu::always_inline]] inline Reals load_in_pairs(const double* from, int count) {
#ifdef RDDL_SIMD_AVX512
    return in_register(load_one_by_one(from, count));
#else
    return load_some(from, count);
#endif
}
// Stores them one by one, so that loads take them from the stores: a load of what a masked store
// has just written waits.
[[gnu::always_inline]] inline void store_one_by_one(double* to, Reals values, int count) {
#ifdef RDDL_SIMD_AVX512
    const __m256d both = _mm512_maskz_extractf64x4_pd(0xF, values, 0);
    const __m128d first = _mm256_castpd256_pd128(both), second = _mm256_extractf128_pd(both, 1);
    _mm_store_sd(to, first);
    if (count > 1) _mm_storeh_pd(to + 1, first);
    if (count > 2) _mm_store_sd(to + 2, second);
    if (count > 3) _mm_storeh_pd(to + 3, second);
#else
    store_some(to, values, count);
#endif
}

}  // namespace rddl::simd::inline RDDL_SIMD_LEVEL
