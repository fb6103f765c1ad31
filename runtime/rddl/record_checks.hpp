// Whether records from outside may be given to an engine, which indexes tables by their objects.
#pragma once

#include <rddl/columns.hpp>
#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace rddl {

namespace detail {

// Whether `value_count` values of type T, at `offset` in each record, are all below `limit`.
template <class T>
bool all_below(std::uint64_t limit, const std::byte* records, std::int64_t record_count,
               std::int64_t record_size, std::int64_t offset, std::int64_t value_count) {
    bool all = true;
    for (std::int64_t i = 0; i < record_count; ++i) {
        const std::byte* values = records + i * record_size + offset;
        for (std::int64_t k = 0; k < value_count; ++k) {
            T value;
            std::memcpy(&value, values + k * static_cast<std::int64_t>(sizeof(T)), sizeof(T));
            all &= value < limit;
        }
    }
    return all;
}

}  // namespace detail

// Every bool must be 0 or 1 and every object value the index of an object; numbers are free.
inline bool records_are_valid(const rddl_problem& problem, rddl_role role, const void* records,
                              std::int64_t record_count) {
    const auto* bytes = static_cast<const std::byte*>(records);
    const std::int64_t size = role == RDDL_ACTION ? problem.action_size : problem.state_size;
    for (std::int32_t f = 0; f < problem.fluent_count; ++f) {
        const rddl_fluent& fluent = problem.fluents[f];
        if (fluent.role != role) continue;
        const auto all_below = [&]<class T>(T limit) {
            return detail::all_below<T>(limit, bytes, record_count, size, fluent.offset,
                                        fluent.count);
        };
        if (fluent.scalar == RDDL_BOOL && !all_below(std::uint8_t{2})) return false;
        if (fluent.range_type < 0) continue;
        const std::int64_t objects = problem.types[fluent.range_type].object_count;
        if (!all_below(static_cast<std::uint64_t>(objects))) return false;
    }
    return true;
}

// Every number must be one, and every object value the index of an object.
template <class Number>
bool values_are_valid(const Columns& columns, const Number* rows, std::int64_t row_count) {
    bool valid = true;
    for (std::int64_t i = 0; i < row_count; ++i, rows += columns.value_count)
        for (const Column& column : columns.list)
            for (std::int64_t k = column.first; k < column.first + column.count; ++k)
                valid &= column.limit > 0 ? rows[k] > Number(-0.5) &&
                                                rows[k] < Number(column.limit) - Number(0.5)
                                          : rows[k] == rows[k];
    return valid;
}

}  // namespace rddl
