// The instance's constants: the values of non-fluents.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <variant>

namespace rddl {

// Row-major over the groundings: one value that most have, and the others by their places, which
// are ascending; other bools need no table. Without places, the others are those of all groundings.
template <class T>
struct ConstantValues {
    T common{};
    std::span<const std::int64_t> places;
    std::span<const T> others;

    T at(std::int64_t grounding) const {
        if (places.empty())
            return others.empty() ? common : others[static_cast<std::size_t>(grounding)];
        const auto place = std::lower_bound(places.begin(), places.end(), grounding);
        if (place == places.end() || *place != grounding) return common;
        if constexpr (std::is_same_v<T, bool>) return !common;
        return others[static_cast<std::size_t>(place - places.begin())];
    }
};

struct Constants {
    std::int32_t fluent;  // index into rddl_problem::fluents
    std::variant<ConstantValues<bool>, ConstantValues<std::int64_t>, ConstantValues<double>> values;
};

// All groundings have the same value.
template <class T>
constexpr Constants constant(std::int32_t fluent, T value) {
    return {fluent, ConstantValues<T>{value, {}, {}}};
}

namespace detail {

// The elements of a table, row-major.
template <class T>
constexpr std::span<const T> elements_of(const T& element) {
    return {&element, 1};
}
template <class Row, std::size_t count>
constexpr auto elements_of(const std::array<Row, count>& table) {
    const auto first = elements_of(table[0]);
    return decltype(first)(first.data(), first.size() * count);
}

}  // namespace detail

// The value of each grounding, by a table over its objects.
template <class Row, std::size_t count>
constexpr Constants constants(std::int32_t fluent, const std::array<Row, count>& table) {
    const auto values = detail::elements_of(table);
    using T = typename decltype(values)::value_type;
    return {fluent, ConstantValues<T>{{}, {}, values}};
}
// A common value, and the others by their places.
template <class T, std::size_t count>
constexpr Constants constants(std::int32_t fluent, T common,
                              const std::array<std::int64_t, count>& places,
                              const std::array<T, count>& others) {
    return {fluent, ConstantValues<T>{common, places, others}};
}
template <std::size_t count>
constexpr Constants constants(std::int32_t fluent, bool common,
                              const std::array<std::int64_t, count>& places) {
    return {fluent, ConstantValues<bool>{common, places, {}}};
}

}  // namespace rddl
