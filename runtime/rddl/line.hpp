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

// That of a row, if the row is one.
template <class R, std::size_t cases>
constexpr Line<R> line_of(const std::array<R, cases>& row) {
    return {row.front(), row[cases > 1] - row.front(), row.back()};
}

}  // namespace rddl
