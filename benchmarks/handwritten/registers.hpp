// Shared parts of the hand-written simulators, for single values and for several in registers.
#pragma once

#include <rddl/values/math.hpp>
#include <rddl/values/pack_ops.hpp>

#include <cstddef>
#include <cstdint>

namespace handwritten {

using rddl::all, rddl::any, rddl::select;

inline std::uint64_t select(bool condition, std::uint64_t a, std::uint64_t b) {
    return condition ? a : b;
}

// Objects of one environment that are computed together.
inline constexpr int lanes_in_one = 8;

template <class R>
R smaller(R a, double b) {
    return select(a < b, a, R{b});
}
template <class R>
R larger(R a, double b) {
    return select(a > b, a, R{b});
}

template <int n>
rddl::Lanes<double, n> gather(const double* table, const rddl::Lanes<std::int64_t, n>& index) {
    rddl::Lanes<double, n> values;
    for (int p = 0; p < values.part_count; ++p)
        values.part[p] = rddl::simd::gather(table, index.part[p]);
    return values;
}

// Integers of 64 bits.
template <class T, int n>
rddl::Lanes<T, n> gather_integers(const T* table, const rddl::Lanes<std::int64_t, n>& index) {
    rddl::Lanes<T, n> values;
#ifdef RDDL_SIMD_AVX512
    for (int p = 0; p < values.part_count; ++p)
        values.part[p] = (typename rddl::Lanes<T, n>::Vector)_mm512_i64gather_epi64(
            (__m512i)index.part[p], table, sizeof(T));
#else
    for (int lane = 0; lane < n; ++lane) values.set(lane, table[index[lane]]);
#endif
    return values;
}

// An entry of a table of eight, which one register holds.
inline std::uint64_t entry_of_eight(const std::uint64_t (&table)[8], std::uint64_t index) {
    return table[index];
}
template <int n>
rddl::Lanes<std::uint64_t, n> entry_of_eight(const std::uint64_t (&table)[8],
                                             const rddl::Lanes<std::uint64_t, n>& index) {
#ifdef RDDL_SIMD_AVX512
    rddl::Lanes<std::uint64_t, n> values;
    for (int p = 0; p < values.part_count; ++p)
        values.part[p] = (rddl::simd::Words)_mm512_permutexvar_epi64((__m512i)index.part[p],
                                                                     _mm512_loadu_si512(table));
    return values;
#else
    return gather_integers(table, rddl::ints_of(index));
#endif
}

// Where the row of each lane begins, in an array of rows of so many elements.
template <class L>
typename L::Int row_starts(std::size_t elements) {
    typename L::Int starts;
    for (int lane = 0; lane < L::width; ++lane)
        starts.set(lane, lane * static_cast<std::int64_t>(elements));
    return starts;
}

inline double lane_of(double value, std::int64_t) {
    return value;
}
inline std::uint64_t lane_of(std::uint64_t value, std::int64_t) {
    return value;
}
inline std::int64_t lane_of(std::int64_t value, std::int64_t) {
    return value;
}
template <class T, int n>
T lane_of(const rddl::Lanes<T, n>& values, std::int64_t lane) {
    return values[static_cast<int>(lane)];
}

// Both of one reduction.
template <class R>
struct SinCos {
    R sin, cos;
};
template <class R>
SinCos<R> sin_cos(R a) {
    const auto [quadrants, rest] = rddl::detail::angle(a);
    const auto s = rddl::detail::sine(rest);
    const auto c = rddl::detail::cosine(rest);
    const R sine = s.high + s.low, cosine = c.high + c.low;
    return {
        rddl::detail::negated_by_bit(quadrants, 1, rddl::first_if_even(quadrants, sine, cosine)),
        rddl::detail::negated_by_bit(quadrants + std::uint64_t{1}, 1,
                                     rddl::first_if_even(quadrants, cosine, sine))};
}

inline std::uint64_t bit_count(std::uint64_t bits) {
    return static_cast<std::uint64_t>(__builtin_popcountll(bits));
}
template <int n>
rddl::Lanes<std::uint64_t, n> bit_count(rddl::Lanes<std::uint64_t, n> bits) {
    for (int p = 0; p < bits.part_count; ++p) {
#if defined(RDDL_SIMD_AVX512) && defined(__AVX512VPOPCNTDQ__)
        bits.part[p] = (rddl::simd::Words)_mm512_maskz_popcnt_epi64(0xFF, (__m512i)bits.part[p]);
#else
        for (int i = 0; i < rddl::simd::lanes; ++i) bits.part[p][i] = bit_count(bits.part[p][i]);
#endif
    }
    return bits;
}
inline double real_of_count(std::uint64_t count) {
    return static_cast<double>(count);
}
template <int n>
rddl::Lanes<double, n> real_of_count(const rddl::Lanes<std::uint64_t, n>& count) {
    return rddl::to_real(rddl::ints_of(count));
}

// Bit k of the result: byte k is not zero. At most 64 bytes.
template <std::size_t count>
std::uint64_t bits_of_bytes(const std::byte* bytes) {
#ifdef RDDL_SIMD_AVX512
    constexpr std::uint64_t all = ~std::uint64_t{0} >> (64 - count);
    const __m512i values = _mm512_maskz_loadu_epi8(all, bytes);
    return _mm512_test_epi8_mask(values, values);
#else
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < count; ++k) bits |= std::uint64_t{bytes[k] != std::byte{0}} << k;
    return bits;
#endif
}
template <std::size_t count>
void store_bits_as_bytes(std::uint64_t bits, std::byte* bytes) {
    for (std::size_t k = 0; k < count; ++k) bytes[k] = static_cast<std::byte>(bits >> k & 1);
}

// The bits with even numbers, one after the other, and the reverse.
constexpr std::uint64_t even_bits(std::uint64_t bits) {
    bits &= 0x5555555555555555;
    bits = (bits | bits >> 1) & 0x3333333333333333;
    bits = (bits | bits >> 2) & 0x0f0f0f0f0f0f0f0f;
    bits = (bits | bits >> 4) & 0x00ff00ff00ff00ff;
    bits = (bits | bits >> 8) & 0x0000ffff0000ffff;
    return (bits | bits >> 16) & 0x00000000ffffffff;
}
constexpr std::uint64_t to_even_bits(std::uint64_t bits) {
    bits &= 0x00000000ffffffff;
    bits = (bits | bits << 16) & 0x0000ffff0000ffff;
    bits = (bits | bits << 8) & 0x00ff00ff00ff00ff;
    bits = (bits | bits << 4) & 0x0f0f0f0f0f0f0f0f;
    bits = (bits | bits << 2) & 0x3333333333333333;
    return (bits | bits << 1) & 0x5555555555555555;
}

// Moves the bits with even numbers to the lower half and the others to the upper half, and the
// reverse.
constexpr std::uint64_t halves(std::uint64_t bits) {
    return even_bits(bits) | even_bits(bits >> 1) << 32;
}
constexpr std::uint64_t joined_halves(std::uint64_t bits) {
    return to_even_bits(bits) | to_even_bits(bits >> 32) << 1;
}

// The lanes 0, 1, 2, ... plus `first`.
template <int n>
rddl::Lanes<std::uint64_t, n> counting_from(std::uint64_t first) {
    rddl::Lanes<std::uint64_t, n> values;
    for (int lane = 0; lane < n; ++lane) values.set(lane, first + static_cast<std::uint64_t>(lane));
    return values;
}

inline bool same(std::uint64_t a, std::uint64_t b) {
    return a == b;
}
template <int n>
rddl::Mask<n> same(const rddl::Lanes<std::uint64_t, n>& a, const rddl::Lanes<std::uint64_t, n>& b) {
    return rddl::ints_of(a) == rddl::ints_of(b);
}

}  // namespace handwritten
