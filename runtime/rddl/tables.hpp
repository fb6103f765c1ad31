// Filling the nested arrays of emitted records and tables.
#pragma once

#include <array>
#include <cstddef>

namespace rddl {

// Copies a table into a record's array of the same shape, or one value into all its elements.
template <class T, class Source>
constexpr void assign(T& target, const Source& source) {
    target = source;
}
template <class T, std::size_t n, class Source, std::size_t m>
constexpr void assign(std::array<T, n>& target, const std::array<Source, m>& source) {
    static_assert(n == m);
    for (std::size_t i = 0; i < n; ++i) assign(target[i], source[i]);
}
template <class T, std::size_t n, class Source>
constexpr void assign(std::array<T, n>& target, const Source& source) {
    for (T& element : target) assign(element, source);
}

// A table of n equal values.
template <std::size_t n>
constexpr std::array<double, n> repeated(double value) {
    std::array<double, n> table{};
    table.fill(value);
    return table;
}

}  // namespace rddl
