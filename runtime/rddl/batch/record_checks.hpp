// Whether records from outside may be given to an engine, which indexes tables by their objects.
#pragma once

#include <rddl/lanes/simd.hpp>
#include <rddl/simulator.h>
#include <rddl/step/columns.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace rddl {

namespace detail {

inline bool are_objects(const std::byte* values, std::int64_t count, std::int64_t object_count) {
    using simd::Words;
    const auto limit = static_cast<std::uint64_t>(object_count);
    decltype(Words{} >= std::uint64_t{}) others{};
    std::int64_t k = 0;
    for (; k + simd::lanes_of<std::uint64_t> <= count; k += simd::lanes_of<std::uint64_t>) {
        Words some;
        std::memcpy(&some, values + 8 * k, sizeof some);
        others |= some >= limit;
    }
    bool all = true;
    for (int i = 0; i < simd::lanes_of<std::uint64_t>; ++i) all &= others[i] == 0;
    for (; k < count; ++k) {
        std::uint64_t value;
        std::memcpy(&value, values + 8 * k, sizeof value);
        all &= value < limit;
    }
    return all;
}

// Whether no value is nan.
template <class Number>
bool are_numbers(const Number* values, std::int64_t count) {
    using Vector = simd::Vector<Number>;
    decltype(Vector{} != Vector{}) nans{};
    std::int64_t k = 0;
    for (; k + simd::lanes_of<Number> <= count; k += simd::lanes_of<Number>) {
        Vector some;
        std::memcpy(&some, values + k, sizeof some);
        nans |= some != some;
    }
    bool all = true;
    for (int i = 0; i < simd::lanes_of<Number>; ++i) all &= nans[i] == 0;
    for (; k < count; ++k) all &= values[k] == values[k];
    return all;
}

// Whether all columns are bools and reals.
inline bool are_plain(const Columns& columns) {
    return std::ranges::all_of(columns.list, [](const Column& column) {
        return column.limit == 0 && column.scalar != RDDL_INT;
    });
}

}  // namespace detail

// Every object value must be the index of an object; bools and numbers are free.
inline bool records_are_valid(const Columns& columns, const std::byte* records,
                              std::int64_t record_count) {
    if (!columns.has_objects) return true;
    // Rows of nothing else lie one behind the other.
    const Column& first = columns.list.front();
    if (columns.list.size() == 1 && 8 * first.count == columns.row_size)
        return detail::are_objects(records, first.count * record_count, first.limit);
    const std::byte* const end = records + record_count * columns.row_size;
    for (const Column& column : columns.list)
        for (const std::byte* row = records; column.limit > 0 && row != end;
             row += columns.row_size)
            if (!detail::are_objects(row + column.row, column.count, column.limit)) return false;
    return true;
}

// Whether every int of these states lies within the bounds of its fluent.
inline bool states_are_bounded(const rddl_problem& problem, const std::byte* records,
                               std::int64_t record_count) {
    bool are_bounded = true;
    for (std::int32_t f = 0; f < problem.fluent_count; ++f) {
        const rddl_fluent& fluent = problem.fluents[f];
        if (fluent.role != RDDL_STATE || fluent.scalar != RDDL_INT || fluent.range_type >= 0)
            continue;
        if (fluent.lower == nullptr || fluent.upper == nullptr) return false;
        const std::byte* first = records + fluent.offset;
        for (std::int64_t i = 0; i < record_count; ++i, first += problem.state_size)
            for (std::int64_t k = 0; k < fluent.count; ++k) {
                std::int64_t value;
                std::memcpy(&value, first + 8 * k, sizeof value);
                const auto number = static_cast<double>(value);
                are_bounded &= number >= fluent.lower[k] && number <= fluent.upper[k];
            }
    }
    return are_bounded;
}

// Whether it is valid for a fluent with this scalar and, if it is of objects, so many of them.
template <class Number>
bool is_valid_number(rddl_scalar scalar, std::int64_t objects, Number value) {
    if (objects > 0) return value > Number(-0.5) && value < Number(objects) - Number(0.5);
    if (scalar == RDDL_INT) return value > Number(-0x1p63) && value < Number(0x1p63);
    return value == value;
}

// Every number must be one, every object value the index of an object, and every int one of 64
// bits.
template <class Number>
bool values_are_valid(const Columns& columns, const Number* rows, std::int64_t row_count) {
    if (detail::are_plain(columns))
        return detail::are_numbers(rows, row_count * columns.value_count);
    bool valid = true;
    for (std::int64_t i = 0; i < row_count; ++i, rows += columns.value_count)
        for (const Column& column : columns.list)
            for (std::int64_t k = column.first; k < column.first + column.count; ++k)
                valid &= is_valid_number(column.scalar, column.limit, rows[k]);
    return valid;
}

}  // namespace rddl
