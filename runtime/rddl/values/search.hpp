// Search in sorted constant tables.
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/values/line.hpp>
#include <rddl/values/ops.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <tuple>
#include <type_traits>

namespace rddl {

namespace detail {

// The number of steps depends on the size of the table only, so that all lanes take the same ones.
template <class Int, class Table, class Value>
constexpr Int search_by_halves(const Table& table, Value value) {
    Int count{0};
    for (Index length = std::tuple_size_v<Table>; length > 0; length /= 2) {
        const Index half = (length + 1) / 2;
        const auto fits = at(table, wrap_add(count, Int{half - 1})) <= value;
        count = select(fits, wrap_add(count, Int{half}), count);
    }
    return count;
}

// Entries so even that a straight line through the first and the last one gives how many are at
// most a value, off by one at the most.
template <const auto& table>
struct EvenEntries {
    using Table = std::remove_cvref_t<decltype(table)>;
    using Entry = typename Table::value_type;
    static constexpr std::size_t size = std::tuple_size_v<Table>;
    // 0 if there is no such line.
    static constexpr Entry per_unit = [] {
        if (size < 2 || !are_moderate(table)) return Entry{0};
        const Entry length = table[size - 1] - table[0];
        return length < 1 / most_in_lines<Entry> ? Entry{0} : static_cast<Entry>(size - 1) / length;
    }();

    static constexpr Entry place_of_zero = per_unit > 0 ? Entry{1} - table[0] * per_unit : Entry{1};

    // The place of the value on that line. nan becomes 0.
    template <class Value>
    static constexpr Value clamped_place(Value value) {
        const Value place = value * per_unit + place_of_zero;
        const Value least = select(place > Entry{0}, place, Value{Entry{0}});
        constexpr auto most = static_cast<Entry>(size);
        return select(least < most, least, Value{most});
    }

    // Between two entries the guess lies between those for the entries, since it never decreases.
    static constexpr bool are_even = [] {
        if (!(per_unit > 0)) return false;
        for (std::size_t i = 0; i < size; ++i) {
            const auto guess = static_cast<std::size_t>(clamped_place<Entry>(table[i]));
            if (guess < i || guess > i + 1) return false;
        }
        return true;
    }();

    // The table with an entry before the first and one after the last that correct no guess.
    static constexpr std::array<Entry, size + 2> bounded = [] {
        std::array<Entry, size + 2> all{};
        all[0] = -std::numeric_limits<Entry>::infinity();
        for (std::size_t i = 0; i < size; ++i) all[i + 1] = table[i];
        all[size + 1] = std::numeric_limits<Entry>::quiet_NaN();
        return all;
    }();

    template <class Int, class Value>
    static constexpr Int count(Value value) {
        const Int guess = truncate_to_int(clamped_place<Value>(value));
        const Int one{1};
        const Int more = select(at(bounded, wrap_add(guess, one)) <= value, one, Int{0});
        const Int less = select(at(bounded, guess) > value, one, Int{0});
        return wrap_sub(wrap_add(guess, more), less);
    }
};

template <const auto& table>
constexpr bool has_even_entries = [] {
    if constexpr (std::is_floating_point_v<
                      typename std::remove_cvref_t<decltype(table)>::value_type>)
        return EvenEntries<table>::are_even;
    else
        return false;
}();

}  // namespace detail

// How many entries of the sorted table are at most the value; 0 if it is nan.
template <const auto& table, class Int, class Value>
constexpr Int search(Value value) {
    if constexpr (detail::has_even_entries<table>)
        return detail::EvenEntries<table>::template count<Int>(value);
    else
        return detail::search_by_halves<Int>(table, value);
}

}  // namespace rddl
