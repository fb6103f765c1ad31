// A few words of 64 bits, for random numbers of one environment: four of them in a register of AVX2
// or half of one of AVX-512, for which processors take half the time, and elsewhere 8 lanes
// (pack.hpp).
#pragma once

#include <rddl/lanes/pack.hpp>
#include <rddl/values/pack_ops.hpp>

#include <algorithm>
#include <cstdint>
#include <type_traits>

namespace rddl::inline RDDL_SIMD_LEVEL {

#ifdef __AVX2__

struct FewWords {
    typedef std::uint64_t Vector __attribute__((vector_size(32)));
    static constexpr int width = 4;

    Vector part;

    FewWords() = default;
    explicit RDDL_INLINE FewWords(std::uint64_t everywhere) : part(everywhere - Vector{}) {}
    explicit RDDL_INLINE FewWords(Vector words) : part(words) {}
    static RDDL_ALWAYS_INLINE FewWords load(const std::uint64_t* from) {
        FewWords words;
        __builtin_memcpy(&words.part, from, sizeof words.part);
        return words;
    }

    friend RDDL_INLINE FewWords operator+(FewWords a, FewWords b) {
        return FewWords(a.part + b.part);
    }
    friend RDDL_INLINE FewWords operator^(FewWords a, FewWords b) {
        return FewWords(a.part ^ b.part);
    }
    friend RDDL_INLINE FewWords operator>>(FewWords a, int count) {
        return FewWords(a.part >> count);
    }
};

RDDL_ALWAYS_INLINE FewWords multiply_low_halves(FewWords a, FewWords b) {
    return FewWords((FewWords::Vector)_mm256_mul_epu32((__m256i)a.part, (__m256i)b.part));
}
RDDL_ALWAYS_INLINE FewWords upper_halves(FewWords a) {
    return FewWords((FewWords::Vector)_mm256_shuffle_epi32((__m256i)a.part, 0xF5));
}
RDDL_ALWAYS_INLINE FewWords join_lower_halves(FewWords low, FewWords high) {
    const auto moved = _mm256_shuffle_epi32((__m256i)high.part, 0xA0);
    return FewWords((FewWords::Vector)_mm256_blend_epi32((__m256i)low.part, moved, 0xAA));
}
// a[0], b[0], a[1], b[1], ...
RDDL_ALWAYS_INLINE Lanes<std::uint64_t, 8> interleaved(FewWords a, FewWords b) {
    Lanes<std::uint64_t, 8> result;
#ifdef RDDL_SIMD_AVX512
    result.part[0] = simd::interleave_half((simd::Words)_mm512_castsi256_si512((__m256i)a.part),
                                           (simd::Words)_mm512_castsi256_si512((__m256i)b.part), 0);
#else
    const auto first = _mm256_unpacklo_epi64((__m256i)a.part, (__m256i)b.part),
               second = _mm256_unpackhi_epi64((__m256i)a.part, (__m256i)b.part);
    result.part[0] = (simd::Words)_mm256_permute2x128_si256(first, second, 0x20);
    result.part[1] = (simd::Words)_mm256_permute2x128_si256(first, second, 0x31);
#endif
    return result;
}
// Which words are less than those in memory; all are less than 2^63.
RDDL_ALWAYS_INLINE std::uint64_t less_words(FewWords a, const std::int64_t* limits) {
    const auto all = _mm256_loadu_si256(reinterpret_cast<const __m256i_u*>(limits));
#ifdef RDDL_SIMD_AVX512
    return _mm256_cmplt_epi64_mask((__m256i)a.part, all);
#else
    const auto is_less = (__m256d)_mm256_cmpgt_epi64(all, (__m256i)a.part);
    return static_cast<std::uint64_t>(_mm256_movemask_pd(is_less));
#endif
}

// The least number of lanes that hold so many words.
template <int count>
using WordsFor =
    std::conditional_t<count <= FewWords::width, FewWords,
                       Lanes<std::uint64_t, std::max(count, simd::lanes_of<std::uint64_t>)>>;

#else

using FewWords = Lanes<std::uint64_t, 8>;
template <int count>
using WordsFor = Lanes<std::uint64_t, std::max(count, simd::lanes_of<std::uint64_t>)>;

#endif

template <int n>
RDDL_ALWAYS_INLINE std::uint64_t less_words(const Lanes<std::uint64_t, n>& a,
                                            const std::int64_t* limits) {
    using Int = Lanes<std::int64_t, n>;
    return (ints_of(a) < Int::load(limits)).bits;
}

}  // namespace rddl::inline RDDL_SIMD_LEVEL
