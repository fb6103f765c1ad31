// How values get from the caller's rows into blocks, and back.
//
// A caller has one row for each environment: a record of the C interface, or a row of a matrix of
// float or double. A block holds L::width environments as one record of emitted code, each value as
// L::Bool, L::Int or L::Real. A column is a fluent in both.
#pragma once

#include <rddl/lane.hpp>
#include <rddl/pack.hpp>
#include <rddl/pack_ops.hpp>
#include <rddl/simulator.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

namespace rddl {

struct Column {
    rddl_scalar scalar;
    std::int64_t limit;  // objects of its type; 0: no objects
    std::int64_t count;  // values in a row
    std::int64_t first;  // the values before it in a row
    std::int64_t row;    // bytes into a record of the C interface
    std::int64_t block;  // bytes into a block
};

struct Columns {
    std::vector<Column> list;
    std::int64_t row_size = 0;       // bytes of a record of the C interface
    std::int64_t value_count = 0;    // of a row
    std::int64_t block_size = 0;     // bytes
    std::int64_t alignment = 1;      // of a block, in bytes
    bool any_value_is_valid = true;  // they are ints and reals
};

// Calls visit.template operator()<T>() with the type that a scalar has in packs or scalars.
template <class L, class Visit>
constexpr void with_type(rddl_scalar scalar, Visit&& visit) {
    if (scalar == RDDL_BOOL)
        visit.template operator()<typename L::Bool>();
    else if (scalar == RDDL_INT)
        visit.template operator()<typename L::Int>();
    else
        visit.template operator()<typename L::Real>();
}

// The fluents of a role, laid out in a block as C++ lays out the emitted struct.
template <class L>
Columns columns_of(const rddl_problem& problem, rddl_role role, std::int64_t row_size) {
    const auto round_up = [](std::int64_t a, std::int64_t unit) {
        return (a + unit - 1) / unit * unit;
    };
    Columns columns;
    columns.row_size = row_size;
    for (std::int32_t f = 0; f < problem.fluent_count; ++f) {
        const rddl_fluent& fluent = problem.fluents[f];
        if (fluent.role != role) continue;
        const bool is_object = fluent.range_type >= 0;
        const std::int64_t limit = is_object ? problem.types[fluent.range_type].object_count : 0;
        with_type<L>(fluent.scalar, [&]<class T>() {
            const std::int64_t offset = round_up(columns.block_size, alignof(T));
            columns.list.push_back(
                {fluent.scalar, limit, fluent.count, columns.value_count, fluent.offset, offset});
            columns.block_size = offset + fluent.count * static_cast<std::int64_t>(sizeof(T));
            columns.alignment = std::max(columns.alignment, static_cast<std::int64_t>(alignof(T)));
        });
        columns.value_count += fluent.count;
        columns.any_value_is_valid &= fluent.scalar != RDDL_BOOL && !is_object;
    }
    columns.block_size = round_up(columns.block_size, columns.alignment);
    return columns;
}

// ---------------------------------------------------------------------------- bools as bits

namespace detail {

// 8 bytes of 0 or 1 as 8 bits, and back; byte i is bit i.
constexpr std::uint64_t bits_of_bytes(std::uint64_t bytes) {
    return bytes * 0x0102040810204080 >> 56;
}
constexpr std::uint64_t bytes_of_bits(std::uint64_t bits) {
    const std::uint64_t selected = bits * 0x0101010101010101 & 0x8040201008040201;
    return (selected + 0x7F7F7F7F7F7F7F7F) >> 7 & 0x0101010101010101;
}

// Of an 8 x 8 matrix of bits, byte i being row i (H. Warren, Hacker's Delight, section 7-3).
constexpr std::uint64_t transposed(std::uint64_t a) {
    const auto swap = [&](std::uint64_t mask, int distance) {
        const std::uint64_t moved = (a ^ a >> distance) & mask;
        a ^= moved ^ moved << distance;
    };
    swap(0x00AA00AA00AA00AA, 7);
    swap(0x0000CCCC0000CCCC, 14);
    swap(0x00000000F0F0F0F0, 28);
    return a;
}

// Up to 8 bytes as a number, the first one lowest.
inline std::uint64_t load_bytes(const std::byte* from, std::int64_t count) {
    std::uint64_t bytes = 0;
    if (count >= 8)
        std::memcpy(&bytes, from, 8);
    else
        for (std::int64_t i = 0; i < count; ++i)
            bytes |= std::to_integer<std::uint64_t>(from[i]) << (8 * i);
    return bytes;
}
inline void store_bytes(std::byte* to, std::int64_t count, std::uint64_t bytes) {
    if (count >= 8)
        std::memcpy(to, &bytes, 8);
    else
        for (std::int64_t i = 0; i < count; ++i) to[i] = static_cast<std::byte>(bytes >> (8 * i));
}

// `count` bools of each of the first `present` rows, 8 x 8 of them at once.
template <int n>
void read_bools(const std::byte* rows, std::int64_t row_size, int present, std::int64_t count,
                Mask<n>* masks) {
    for (std::int64_t k = 0; k < count; k += 8) {
        const int chunk = static_cast<int>(std::min<std::int64_t>(8, count - k));
        for (int i = 0; i < chunk; ++i) masks[k + i] = false;
        for (int lane = 0; lane < present; lane += 8) {
            std::uint64_t square = 0;
            for (int i = 0; i < 8 && lane + i < present; ++i)
                square |= bits_of_bytes(load_bytes(rows + (lane + i) * row_size + k, chunk))
                          << (8 * i);
            square = transposed(square);
            for (int i = 0; i < chunk; ++i)
                masks[k + i] = masks[k + i] || Mask<n>::of_bits((square >> (8 * i) & 0xFF) << lane);
        }
    }
}
template <int n>
void write_bools(const Mask<n>* masks, std::int64_t count, std::byte* rows, std::int64_t row_size,
                 int present) {
    for (std::int64_t k = 0; k < count; k += 8) {
        const int chunk = static_cast<int>(std::min<std::int64_t>(8, count - k));
        for (int lane = 0; lane < present; lane += 8) {
            std::uint64_t square = 0;
            for (int i = 0; i < chunk; ++i)
                square |= (std::uint64_t{masks[k + i].bits} >> lane & 0xFF) << (8 * i);
            square = transposed(square);
            for (int i = 0; i < 8 && lane + i < present; ++i)
                store_bytes(rows + (lane + i) * row_size + k, chunk,
                            bytes_of_bits(square >> (8 * i) & 0xFF));
        }
    }
}

// What a record of the C interface holds for a value of one lane: all reals are double there.
template <class T>
using InRecord = std::conditional_t<std::is_same_v<T, float>, double, T>;

// One number of each of the first `present` rows.
template <class T>
T read_numbers(const std::byte* rows, std::int64_t row_size, int present) {
    InRecord<typename T::Element> numbers[T::width] = {};
    if (row_size == 8 && present == T::width)
        std::memcpy(numbers, rows, sizeof numbers);
    else
        for (int lane = 0; lane < present; ++lane)
            std::memcpy(&numbers[lane], rows + lane * row_size, 8);
    typename T::Element lanes[T::width];
    for (int lane = 0; lane < T::width; ++lane)
        lanes[lane] = static_cast<typename T::Element>(numbers[lane]);
    return T::load(lanes);
}
template <class T>
void write_numbers(const T& values, std::byte* rows, std::int64_t row_size, int present) {
    typename T::Element lanes[T::width];
    values.store(lanes);
    InRecord<typename T::Element> numbers[T::width];
    for (int lane = 0; lane < T::width; ++lane) numbers[lane] = lanes[lane];
    if (row_size == 8 && present == T::width)
        std::memcpy(rows, numbers, sizeof numbers);
    else
        for (int lane = 0; lane < present; ++lane)
            std::memcpy(rows + lane * row_size, &numbers[lane], 8);
}

template <class T>
const T* values_in(const std::byte* block, const Column& column) {
    return reinterpret_cast<const T*>(block + column.block);
}
template <class T>
T* values_in(std::byte* block, const Column& column) {
    return reinterpret_cast<T*>(block + column.block);
}

}  // namespace detail

// ---------------------------------------------------------------------------- single values

// Of the first `present` lanes.
inline void write_reals(double value, double* to, int) {
    *to = value;
}
template <class R, int n>
void write_reals(const Lanes<R, n>& values, double* to, int present) {
    detail::write_numbers(values, reinterpret_cast<std::byte*>(to), 8, present);
}

// A byte of 0 or 1 each.
template <int n>
void write_flags(Mask<n> mask, std::uint8_t* flags, int present) {
    for (int lane = 0; lane < present; lane += 8)
        detail::store_bytes(reinterpret_cast<std::byte*>(flags + lane), present - lane,
                            detail::bytes_of_bits(std::uint64_t{mask.bits} >> lane & 0xFF));
}
inline void write_flags(bool value, std::uint8_t* flags, int) {
    *flags = value;
}

// ---------------------------------------------------------------------------------- records

// Of the first `present` lanes; the others become zero.
inline void read_records(Scalar, const Columns& columns, const std::byte* rows, int,
                         std::byte* block) {
    if (columns.row_size > 0) std::memcpy(block, rows, static_cast<std::size_t>(columns.row_size));
}
template <int n, class R>
void read_records(Pack<n, R>, const Columns& columns, const std::byte* rows, int present,
                  std::byte* block) {
    const auto read_numbers = [&]<class T>(const Column& column, T* values) {
        for (std::int64_t k = 0; k < column.count; ++k)
            values[k] =
                detail::read_numbers<T>(rows + column.row + 8 * k, columns.row_size, present);
    };
    for (const Column& column : columns.list)
        with_type<Pack<n, R>>(column.scalar, [&]<class T>() {
            T* const values = detail::values_in<T>(block, column);
            if constexpr (std::is_same_v<T, Mask<n>>)
                detail::read_bools(rows + column.row, columns.row_size, present, column.count,
                                   values);
            else
                read_numbers(column, values);
        });
}

inline void write_records(Scalar, const Columns& columns, const std::byte* block, std::byte* rows,
                          int) {
    if (columns.row_size > 0) std::memcpy(rows, block, static_cast<std::size_t>(columns.row_size));
}
template <int n, class R>
void write_records(Pack<n, R>, const Columns& columns, const std::byte* block, std::byte* rows,
                   int present) {
    const auto write_numbers = [&]<class T>(const Column& column, const T* values) {
        for (std::int64_t k = 0; k < column.count; ++k)
            detail::write_numbers(values[k], rows + column.row + 8 * k, columns.row_size, present);
    };
    for (const Column& column : columns.list)
        with_type<Pack<n, R>>(column.scalar, [&]<class T>() {
            const T* const values = detail::values_in<T>(block, column);
            if constexpr (std::is_same_v<T, Mask<n>>)
                detail::write_bools(values, column.count, rows + column.row, columns.row_size,
                                    present);
            else
                write_numbers(column, values);
        });
}

// The record of one lane. Padding stays as it is.
template <class L>
void write_record(L, const Columns& columns, const std::byte* block, int lane, std::byte* row) {
    for (const Column& column : columns.list)
        with_type<L>(column.scalar, [&]<class T>() {
            const T* const values = detail::values_in<T>(block, column);
            for (std::int64_t k = 0; k < column.count; ++k) {
                const auto number = get_lane(values[k], lane);
                const detail::InRecord<std::remove_const_t<decltype(number)>> value = number;
                std::memcpy(row + column.row + k * static_cast<std::int64_t>(sizeof value), &value,
                            sizeof value);
            }
        });
}
template <class L>
void read_record(L, const Columns& columns, const std::byte* row, std::byte* block, int lane) {
    for (const Column& column : columns.list)
        with_type<L>(column.scalar, [&]<class T>() {
            T* const values = detail::values_in<T>(block, column);
            for (std::int64_t k = 0; k < column.count; ++k) {
                using Number = decltype(get_lane(values[k], lane));
                detail::InRecord<Number> value;
                std::memcpy(&value, row + column.row + k * static_cast<std::int64_t>(sizeof value),
                            sizeof value);
                set_lane(values[k], lane, static_cast<Number>(value));
            }
        });
}

// The records of single environments whose reals have another width.
inline void read_records(ScalarOf<float> lanes, const Columns& columns, const std::byte* rows, int,
                         std::byte* block) {
    read_record(lanes, columns, rows, block, 0);
}
inline void write_records(ScalarOf<float> lanes, const Columns& columns, const std::byte* block,
                          std::byte* rows, int) {
    write_record(lanes, columns, block, 0, rows);
}

// ------------------------------------------------------------------------ matrices of reals

// Row-major, `value_count` numbers a row: bools are 0 and 1, objects their index.
template <class L, class Number>
void read_values(L, const Columns& columns, const Number* rows, int present, std::byte* block) {
    for (const Column& column : columns.list)
        with_type<L>(column.scalar, [&]<class T>() {
            T* const values = detail::values_in<T>(block, column);
            for (std::int64_t k = 0; k < column.count; ++k) {
                const Number* number = rows + column.first + k;
                for (int lane = 0; lane < present; ++lane, number += columns.value_count) {
                    using Value = decltype(get_lane(values[k], lane));
                    if constexpr (std::is_same_v<Value, bool>)
                        set_lane(values[k], lane, *number > Number{0.5});
                    else if constexpr (std::is_same_v<Value, std::int64_t>)
                        set_lane(values[k], lane, round(static_cast<double>(*number)));
                    else
                        set_lane(values[k], lane, static_cast<Value>(*number));
                }
            }
        });
}
template <class L, class Number>
void write_values(L, const Columns& columns, const std::byte* block, Number* rows, int present) {
    for (const Column& column : columns.list)
        with_type<L>(column.scalar, [&]<class T>() {
            const T* const values = detail::values_in<T>(block, column);
            for (std::int64_t k = 0; k < column.count; ++k) {
                Number* number = rows + column.first + k;
                for (int lane = 0; lane < present; ++lane, number += columns.value_count)
                    *number = static_cast<Number>(get_lane(values[k], lane));
            }
        });
}

// -------------------------------------------------------------------------------- in blocks

// Takes over another block's values where the mask holds.
template <class R>
void merge(ScalarOf<R>, const Columns& columns, bool mask, const std::byte* from,
           std::byte* block) {
    if (mask && columns.block_size > 0)
        std::memcpy(block, from, static_cast<std::size_t>(columns.block_size));
}
template <int n, class R>
void merge(Pack<n, R>, const Columns& columns, Mask<n> mask, const std::byte* from,
           std::byte* block) {
    if (all(mask) && columns.block_size > 0) {
        std::memcpy(block, from, static_cast<std::size_t>(columns.block_size));
        return;
    }
    if (!any(mask)) return;
    for (const Column& column : columns.list)
        with_type<Pack<n, R>>(column.scalar, [&]<class T>() {
            const T* const theirs = detail::values_in<T>(from, column);
            T* const ours = detail::values_in<T>(block, column);
            for (std::int64_t k = 0; k < column.count; ++k)
                ours[k] = select(mask, theirs[k], ours[k]);
        });
}

}  // namespace rddl
