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

// For so few values that a loop over registers would take longer to begin than to run.
RDDL_INLINE bool are_few_objects(const std::byte* values, std::int64_t count,
                                 std::int64_t object_count) {
    bool all = true;
    for (std::int64_t k = 0; k < count; ++k) {
        std::uint64_t value;
        std::memcpy(&value, values + 8 * k, sizeof value);
        all &= value < static_cast<std::uint64_t>(object_count);
    }
    return all;
}
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
    return are_few_objects(values + 8 * k, count - k, object_count) && all;
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

// The same of one record, which mostly has few objects.
RDDL_INLINE bool record_is_valid(const Columns& columns, const std::byte* record) {
    bool all = true;
    for (const Column& column : columns.list) {
        if (column.limit == 0) continue;
        const std::byte* const values = record + column.row;
        all &= column.count < simd::lanes_of<std::uint64_t>
                   ? detail::are_few_objects(values, column.count, column.limit)
                   : detail::are_objects(values, column.count, column.limit);
    }
    return all;
}

#ifdef RDDL_SIMD_BYTE_INTS
// Reads whole blocks of objects alone (are_read_when_checked); whether all are valid.
template <class L>
bool read_objects(const Columns& columns, const std::byte* records, std::int64_t block_count,
                  std::byte* blocks) {
    using Int = typename L::Int;
    const Column& column = columns.list.front();
    const Int last = static_cast<std::int8_t>(column.limit - 1);
    const std::int64_t size = L::width * columns.row_size;
    return detail::with_byte_row(column.count, [&]<int n>(std::integral_constant<int, n>) {
        simd::Words any{};
        typename L::Bool are_objects{true};
        for (std::int64_t b = 0; b < block_count; ++b) {
            const std::byte* const rows = records + b * size;
            auto* const values = reinterpret_cast<Int*>(blocks + b * columns.block_size);
            detail::prefetch_rows(rows, size);
            detail::read_rows_of_byte_ints(rows, columns.row_size, n, values, any);
            for (int i = 0; i < n; ++i) are_objects = are_objects && values[i] <= last;
        }
        const auto* const words = reinterpret_cast<const std::byte*>(&any);
        return all(are_objects) && detail::are_objects(words, simd::lanes, most_byte_objects);
    });
}
#endif

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
