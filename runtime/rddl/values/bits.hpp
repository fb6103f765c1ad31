// Tables of bools as the bits of ints, and what is done with them.
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/lanes/pack.hpp>
#include <rddl/lanes/simd.hpp>
#include <rddl/lanes/simd_bytes.hpp>
#include <rddl/values/bool_rows.hpp>
#include <rddl/values/pack_ops.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>
#include <utility>

namespace rddl {

namespace detail {

// The first of the elements of nested arrays, which lie one after the other, and their number.
template <class T>
constexpr T* first_element(T& value) {
    return &value;
}
template <class T, std::size_t n>
constexpr auto first_element(const std::array<T, n>& table) {
    return first_element(table[0]);
}
template <class T, std::size_t n>
constexpr auto first_element(std::array<T, n>& table) {
    return first_element(table[0]);
}
template <class T>
inline constexpr Index element_count = Nested<T>::count;

// Element i of nested arrays, in row-major order, also where compilers evaluate it.
template <class T>
constexpr const T& element_at(const T& element, std::size_t) {
    return element;
}
template <class T, std::size_t n>
constexpr const auto& element_at(const std::array<T, n>& table, std::size_t i) {
    constexpr auto count = static_cast<std::size_t>(element_count<T>);
    return element_at(table[i / count], i % count);
}

// Whether the bools may have been stored just now matters to one environment's (simd.hpp).
template <int count, bool just_stored>
std::int64_t bits_of(const bool* bools) {
    return static_cast<std::int64_t>(just_stored ? simd::bits_of_stored_bytes(bools, count)
                                                 : simd::bits_of_bytes(bools, count));
}
template <int count, bool, int n>
Lanes<std::int64_t, n> bits_of(const Mask<n>* bools) {
    return bits_in_lanes<count>(bools);
}
template <int count>
RDDL_INLINE Lanes<std::int8_t, 64> byte_ints(const Mask<64>* bools) {
    return Lanes<std::int8_t, 64>::each(
        [bools]() RDDL_INLINE_LAMBDA { return simd::joined_masks<count>(&bools->bits); });
}
template <int count>
RDDL_INLINE void store_bits(std::int64_t bits, bool* bools) {
    simd::store_as_bytes<(count > 16 ? 64 : 16)>(static_cast<std::uint64_t>(bits), bools, count);
}
template <int count, int n>
RDDL_INLINE void store_bits(const Lanes<std::int64_t, n>& bits, Mask<n>* bools) {
    store_lanes<count>(bits, bools);
}
template <int count, int n>
RDDL_INLINE void store_bits(const Lanes<std::int8_t, n>& bits, Mask<n>* bools) {
    for (int i = 0; i < count; ++i)
        bools[i] = Mask<n>::of_bits(simd::lanes_of_bit(bits.part[0], i));
}

}  // namespace detail

// The elements [first, first + 64) of a table of bools, in row-major order, as bits of an int, the
// first one lowest; bits beyond its end are 0.
template <Index first = 0, bool just_stored = true, class Table>
auto bits(const Table& table) {
    constexpr Index count = std::min<Index>(detail::element_count<Table> - first, 64);
    return detail::bits_of<static_cast<int>(count), just_stored>(detail::first_element(table) +
                                                                 first);
}
// The bits of a table of at most 7 bools, as `bits` has them. Packs have them as byte ints, if the
// processor has any.
template <Index first = 0, bool just_stored = true, class Table>
RDDL_INLINE auto byte_bits(const Table& table) {
    constexpr auto count = static_cast<int>(detail::element_count<Table> - first);
    static_assert(count <= 7);
    const auto* const bools = detail::first_element(table) + first;
#ifdef RDDL_SIMD_BYTE_INTS
    if constexpr (std::is_same_v<decltype(bools), const Mask<64>* const>)
        return detail::byte_ints<count>(bools);
    else
#endif
        return detail::bits_of<count, just_stored>(bools);
}
// Whether one element at least is true in a table of one environment.
template <class Table>
RDDL_INLINE bool is_any_true(const Table& table) {
    return simd::is_any_stored_byte<static_cast<int>(detail::element_count<Table>)>(
        detail::first_element(table));
}
// Whether one element is true in all of these rows of bools, which have equally many. One
// environment joins their bytes.
template <class First, class... Others>
RDDL_INLINE auto is_any_in_all(const First& first, const Others&... others) {
    constexpr Index count = detail::element_count<First>;
    if constexpr (std::is_same_v<First, std::array<bool, static_cast<std::size_t>(count)>>) {
        return simd::is_any_byte_in_all<static_cast<int>(count)>(&first, &others...);
    } else {
        auto any = first[0] && (others[0] && ...);
        for (std::size_t i = 1; i < first.size(); ++i)
            any = any || (first[i] && (others[i] && ...));
        return any;
    }
}
// Whether all bools of these tables of the action are false, in packs for all environments.
template <class... Choices>
RDDL_INLINE bool is_unchosen(const Choices&... choices) {
    return !(simd::is_any_stored_byte<static_cast<int>(sizeof(Choices))>(&choices) || ...);
}
// Several tables, to be copied at once.
template <class... Tables>
RDDL_INLINE auto tables(Tables&... all) {
    return std::tie(all...);
}
// Copies a table of the state, or several, if nothing is chosen, and says so.
template <class Next, class State, class... Choices>
RDDL_INLINE bool keep_unchosen(Next&& next, const State& state, const Choices&... choices) {
    if (!is_unchosen(choices...)) return false;
    next = state;
    return true;
}
// The bits of the caller's actions.
template <Index first = 0, class Table>
auto action_bits(const Table& table) {
    return bits<first, false>(table);
}
template <Index first = 0, class Table>
RDDL_INLINE auto byte_action_bits(const Table& table) {
    return byte_bits<first, false>(table);
}

namespace detail {

template <bool just_stored, class Table>
RDDL_INLINE auto words(const Table& table) {
    constexpr std::size_t count = (static_cast<std::size_t>(element_count<Table>) + 63) / 64;
    return [&table]<std::size_t... word>(std::index_sequence<word...>) RDDL_INLINE_LAMBDA {
        return std::array<std::uint64_t, count>{
            static_cast<std::uint64_t>(bits<Index{64 * word}, just_stored>(table))...};
    }
    (std::make_index_sequence<count>());
}

}  // namespace detail

// All elements of a table of one environment, 64 in each word; and those of the caller's action.
template <class Table>
RDDL_INLINE auto words_of(const Table& table) {
    return detail::words<true>(table);
}
template <class Table>
RDDL_INLINE auto action_words_of(const Table& table) {
    return detail::words<false>(table);
}

namespace detail {

template <std::size_t n>
RDDL_INLINE int count_ones_of(const std::array<std::uint64_t, n>& words) {
    int total = 0;
    for (const std::uint64_t bits : words) total += __builtin_popcountll(bits);
    return total;
}
// Calls visit(i) for all i whose bit is 1.
template <std::size_t n, class Visit>
RDDL_INLINE void for_each_one(const std::array<std::uint64_t, n>& words, Visit&& visit) {
    Index first = 0;
    for (std::uint64_t bits : words) {
        for (; bits != 0; bits &= bits - 1) visit(first + __builtin_ctzll(bits));
        first += 64;
    }
}

}  // namespace detail

// The element of a table of bools that has this place in row-major order.
template <class Table>
RDDL_INLINE const auto& element(const Table& table, Index place) {
    return detail::first_element(table)[place];
}

// Whether a byte that a caller has given for a bool is not 0; in packs they are masks already.
RDDL_ALWAYS_INLINE bool is_true(const bool& given) {
    return *reinterpret_cast<const unsigned char*>(&given) != 0;
}
template <int n>
RDDL_INLINE Mask<n> is_true(const Mask<n>& given) {
    return given;
}

// ------------------------------------------------------------------------------- bit by bit

constexpr std::int64_t bit_and(std::int64_t a, std::int64_t b) {
    return a & b;
}
constexpr std::int64_t bit_or(std::int64_t a, std::int64_t b) {
    return a | b;
}
constexpr std::int64_t bit_xor(std::int64_t a, std::int64_t b) {
    return a ^ b;
}
template <class A, class B>
requires SomePack<A, B> RDDL_INLINE auto bit_and(const A& a, const B& b) {
    using Int = CommonInts<A, B>;
    return Int(a) & Int(b);
}
template <class A, class B>
requires SomePack<A, B> RDDL_INLINE auto bit_or(const A& a, const B& b) {
    using Int = CommonInts<A, B>;
    return Int(a) | Int(b);
}
template <class A, class B>
requires SomePack<A, B> RDDL_INLINE auto bit_xor(const A& a, const B& b) {
    using Int = CommonInts<A, B>;
    return Int(a) ^ Int(b);
}

// The bits from `first` on, 0 <= first < 64.
constexpr std::int64_t shift_right(std::int64_t bits, std::int64_t first) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(bits) >> first);
}
template <int n>
RDDL_INLINE Lanes<std::int64_t, n> shift_right(const Lanes<std::int64_t, n>& bits,
                                               std::int64_t first) {
    return ints_of(words_of(bits) >> static_cast<int>(first));
}

// The bits of an int fill a row of a table of bools, the lowest one first.
template <class Table, class Int>
RDDL_INLINE void spread(Table& row, const Int& bits) {
    constexpr Index count = detail::element_count<Table>;
    static_assert(count <= 64);
    detail::store_bits<static_cast<int>(count)>(bits, detail::first_element(row));
}

// How many bits are 1.
constexpr std::int64_t count_ones(std::int64_t a) {
    return __builtin_popcountll(static_cast<std::uint64_t>(a));
}
template <class T, int n>
RDDL_INLINE Lanes<T, n> count_ones(const Lanes<T, n>& a) {
    return Lanes<T, n>::each([](auto bits) RDDL_INLINE_LAMBDA { return simd::count_ones(bits); },
                             a);
}

}  // namespace rddl
