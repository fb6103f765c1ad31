// A row of numbers that lie on a line.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>

namespace rddl {

// Rises from the first element by equal steps, but to the last element at most, which may repeat.
template <std::floating_point R>
struct Line {
    R first, rise, last;

    constexpr R at(std::size_t count) const {
        return std::min(first + rise * static_cast<R>(count), last);
    }
};

// Whether constant expressions may compute with the elements of a table: they may not overflow, nor
// make a nan. Sums of such numbers, their products with each other and with the size of the table,
// and quotients by those that are at least 1 / most_in_lines do neither.
template <std::floating_point R>
constexpr R most_in_lines = std::same_as<R, float> ? R(1e15) : R(1e150);

template <std::floating_point R, std::size_t size>
constexpr bool are_moderate(const std::array<R, size>& table) {
    return std::ranges::all_of(table,
                               [](R x) { return -most_in_lines<R> <= x && x <= most_in_lines<R>; });
}

// The line of a row of moderate numbers, if the row is one.
template <class R, std::size_t cases>
constexpr Line<R> line_of(const std::array<R, cases>& row) {
    return {row.front(), row[cases > 1] - row.front(), row.back()};
}

}  // namespace rddl
