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

// Bit for bit.
template <class R, std::size_t cases>
constexpr bool is_line(const std::array<R, cases>& row) {
    if (!are_moderate(row)) return false;
    for (std::size_t count = 0; count < cases; ++count)
        if (rddl::bits_of(line_of(row).at(count)) != rddl::bits_of(row[count])) return false;
    return true;
}

template <const auto& rows>
inline constexpr bool are_lines = std::ranges::all_of(rows,
                                                      [](const auto& row) { return is_line(row); });

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

template <class R, int n>
RDDL_INLINE Lanes<R, n> reals(const Lanes<std::int64_t, n>& ints) {
    if constexpr (std::same_as<R, float>)
        return to_float(ints);
    else
        return to_real(ints);
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
    if constexpr (detail::are_lines<rows>) {
        constexpr const auto& lines = detail::lines<rows, kinds...>;
        using R = typename std::remove_cvref_t<decltype(lines.first)>::value_type;
        const auto steps = detail::reals<R>(Lanes<std::int64_t, n>(count));
        const auto value = at(lines.first, x) + at(lines.rise, x) * steps;
        // Takes the minimum as std::min does, for Line: without the care for nan that minimum has.
        return Lanes<R, n>::each([](auto a, auto b) { return b < a ? b : a; }, value,
                                 at(lines.last, x));
    } else if constexpr (sizeof...(kinds) == 0) {
        return at(rows, x, count);
    } else {
        return at_own(rows, x, at(kinds, x)..., count);
    }
}

}  // namespace rddl
