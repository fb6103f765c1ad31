// Tables with a row for each object, or for each kind of objects, of which a count chooses an
// element.
//
// Packs of environments look it up. Several objects of one environment would have to gather it, one
// lane after the other; but rows are often lines, as chances are that rise by the same with each
// neighbour, and then it is computed. Compilers find out whether every element is the same bit for
// bit.
#pragma once

#include <rddl/lanes/real.hpp>
#include <rddl/object_lanes/objects.hpp>
#include <rddl/values/line.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <type_traits>

namespace rddl {
namespace detail {

// The differences of a row's elements from its line, in units of the last place, are parts of a
// word: as many bits each as shifts need not multiply for.
template <std::size_t cases>
struct Differences {
    static constexpr std::uint64_t bits = std::min<std::uint64_t>(std::bit_floor(64 / cases), 8);
    static constexpr std::int64_t greatest = bits == 0 ? 0 : (std::int64_t{1} << (bits - 1)) - 1;
};
template <class R, std::size_t cases>
constexpr std::int64_t difference_at(const std::array<R, cases>& row, std::size_t count) {
    const auto bits = rddl::bits_of(row[count]);  // the difference wraps around
    using Difference = std::make_signed_t<std::remove_const_t<decltype(bits)>>;
    return static_cast<Difference>(bits - rddl::bits_of(line_of(row).at(count)));
}
template <class R, std::size_t cases>
constexpr bool is_near_line(const std::array<R, cases>& row, std::int64_t greatest) {
    if (!are_moderate(row)) return false;
    for (std::size_t count = 0; count < cases; ++count) {
        const std::int64_t difference = difference_at(row, count);
        if (difference < -greatest || difference > greatest) return false;
    }
    return true;
}

// Bit for bit.
template <const auto& rows>
inline constexpr bool are_lines = std::ranges::all_of(rows, [](const auto& row) {
    return is_near_line(row, 0);
});
template <const auto& rows>
inline constexpr bool are_nearly_lines =
    std::ranges::all_of(rows, []<class R, std::size_t cases>(const std::array<R, cases>& row) {
        return Differences<cases>::bits > 1 && is_near_line(row, Differences<cases>::greatest);
    });

// The number of each object's row.
template <const auto& rows>
constexpr auto row_numbers() {
    std::array<std::int64_t, std::size(rows)> numbers{};
    std::iota(numbers.begin(), numbers.end(), std::int64_t{0});
    return numbers;
}
template <const auto&, const auto& kinds>
constexpr auto row_numbers() {
    return std::bit_cast<std::array<std::int64_t, sizeof kinds / sizeof(std::int64_t)>>(kinds);
}

// The lines by object.
template <class R, std::size_t objects>
struct Lines {
    std::array<R, objects> first, rise, last;
};
template <const auto& rows, const auto&... kinds>
inline constexpr auto lines = [] {
    constexpr auto numbers = row_numbers<rows, kinds...>();
    Lines<typename Nested<std::remove_cvref_t<decltype(rows)>>::Element, numbers.size()> all{};
    for (std::size_t x = 0; x < numbers.size(); ++x) {
        const auto line = line_of(rows[static_cast<std::size_t>(numbers[x])]);
        all.first[x] = line.first;
        all.rise[x] = line.rise;
        all.last[x] = line.last;
    }
    return all;
}();

// By object the differences of its elements, the first one in the highest bits.
template <const auto& rows, const auto&... kinds>
inline constexpr auto differences = [] {
    constexpr auto numbers = row_numbers<rows, kinds...>();
    std::array<std::int64_t, numbers.size()> all{};
    for (std::size_t x = 0; x < numbers.size(); ++x) {
        const auto& row = rows[static_cast<std::size_t>(numbers[x])];
        constexpr std::uint64_t bits =
            Differences<std::tuple_size_v<std::remove_cvref_t<decltype(row)>>>::bits;
        std::uint64_t word = 0;
        for (std::size_t count = 0; count < row.size(); ++count)
            word |= static_cast<std::uint64_t>(difference_at(row, count)) << (64 - bits) >>
                    bits * count;
        all[x] = static_cast<std::int64_t>(word);
    }
    return all;
}();

template <class R, int n>
RDDL_INLINE Lanes<R, n> reals(const Lanes<std::int64_t, n>& ints) {
    if constexpr (std::same_as<R, float>)
        return to_float(ints);
    else
        return to_real(ints);
}

// The element at `count` of each object's line.
template <const auto& rows, const auto&... kinds, int n, class Count>
RDDL_INLINE auto at_line(const SomeObjects<n>& x, const Count& count) {
    constexpr const auto& of_objects = lines<rows, kinds...>;
    using R = typename std::remove_cvref_t<decltype(of_objects.first)>::value_type;
    const auto steps = reals<R>(Lanes<std::int64_t, n>(count));
    const auto value = at(of_objects.first, x) + at(of_objects.rise, x) * steps;
    // Takes the minimum as std::min does, for Line: without the care for nan that minimum has.
    return Lanes<R, n>::each([](auto a, auto b) RDDL_INLINE_LAMBDA { return b < a ? b : a; }, value,
                             at(of_objects.last, x));
}
template <const auto& rows, const auto&... kinds, int n, class Count>
RDDL_INLINE auto at_near_line(const SomeObjects<n>& x, const Count& count) {
    using Row = typename std::remove_cvref_t<decltype(rows)>::value_type;
    constexpr int bits = Differences<std::tuple_size_v<Row>>::bits;
    using Int = Lanes<std::int64_t, n>;
    const Int difference = Int::each(
        [](auto word, auto place) RDDL_INLINE_LAMBDA {
            const auto first = (decltype(place))word << place * bits;
            return (decltype(word))first >> (64 - bits);
        },
        at(differences<rows, kinds...>, x), words_of(Int(count)));
    const auto value = at_line<rows, kinds...>(x, count);
    if constexpr (std::same_as<typename Row::value_type, float>)
        return real_of_bits(bits_of(value) + lower_halves(words_of(difference)));
    else
        return real_of_bits(bits_of(value) + words_of(difference));
}

}  // namespace detail

// The element at `count` of the row of an object, or of its kind.
template <const auto& rows, class Count>
RDDL_INLINE auto at_row(OneObject x, const Count& count) {
    return at(rows, x, count);
}
template <const auto& rows, const auto& kinds, class Count>
RDDL_INLINE auto at_row(OneObject x, const Count& count) {
    return at(rows, at(kinds, x), count);
}
template <const auto& rows, const auto&... kinds, int n, class Count>
RDDL_INLINE auto at_row(const SomeObjects<n>& x, const Count& count) {
    if constexpr (detail::are_lines<rows>)
        return detail::at_line<rows, kinds...>(x, count);
    else if constexpr (detail::are_nearly_lines<rows>)
        return detail::at_near_line<rows, kinds...>(x, count);
    else if constexpr (sizeof...(kinds) == 0)
        return at(rows, x, count);
    else
        return at_own(rows, x, at(kinds, x)..., count);
}

}  // namespace rddl
