// Filling the nested arrays of emitted records and tables.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

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
// Assigns the same elements. GCC 12 makes wrong copies of some constants for AVX-512 (of {1, 1, 0,
// 0} for one, four times 1), so it must not know what it copies.
template <class T, std::size_t n>
constexpr void assign(std::array<T, n>& target, const std::array<T, n>& source) {
    const std::array<T, n>* hidden = &source;
#ifdef __GNUC__
    if (!std::is_constant_evaluated()) asm("" : "+r"(hidden));
#endif
    target = *hidden;
}
template <class T, std::size_t n, class Source>
constexpr void assign(std::array<T, n>& target, const Source& source) {
    for (T& element : target) assign(element, source);
}

// Makes a table that is too large for compilers to compute.
template <class Make, class... Arguments>
auto made_at_start(const Make& make, Arguments... arguments) {
    return make(arguments...);
}

// A table of n equal values.
template <std::size_t n>
constexpr std::array<double, n> repeated(double value) {
    std::array<double, n> table{};
    table.fill(value);
    return table;
}

}  // namespace rddl
