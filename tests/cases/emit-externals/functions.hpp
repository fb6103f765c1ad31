#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace rddl_extern {

// Takes any size: a span of dynamic extent accepts those of fixed extent.
inline void bought(std::span<const bool> buys, std::span<const std::int64_t> stock,
                   std::int64_t limit, std::span<std::int64_t> result) {
    for (std::size_t g = 0; g < buys.size(); ++g)
        result[g] = buys[g] ? std::min(stock[g], limit) : 0;
}

inline double price_of(double price, bool is_known) {
    return is_known ? price : 1.5 * price;
}

// Takes the size that the instance has.
template <class T, std::size_t rows, std::size_t columns>
void blend(std::span<const std::array<T, columns>, rows> table,
           std::span<std::array<double, columns>, rows> result) {
    for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t j = 0; j < columns; ++j)
            result[i][j] =
                0.25 * static_cast<double>(table[i][j] + 3 * table[i][(j + 1) % columns]);
}

inline bool any(std::span<const bool> values) {
    return std::ranges::find(values, true) != values.end();
}

// Overloaded: an int of whatever is counted.
template <class T, std::size_t n>
std::int64_t total(std::span<const T, n> values) {
    std::int64_t sum = 0;
    for (const T& value : values) sum += value;
    return sum;
}
template <std::size_t n, std::size_t m>
std::int64_t total(std::span<const std::array<std::int64_t, m>, n> values) {
    std::int64_t sum = 0;
    for (const auto& row : values) sum += total(std::span<const std::int64_t, m>(row));
    return sum;
}

}  // namespace rddl_extern
