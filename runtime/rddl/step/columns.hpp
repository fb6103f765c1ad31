// How values get from the caller's rows into blocks, and back.
//
// A caller has one row for each environment: a record of the C interface, or a row of a matrix of
// float or double. A block holds L::width environments as one record of emitted code, each value as
// L::Bool, L::Int or L::Real. A column is a fluent in both, or, where there are many, as many
// fluents of one kind as lie beside each other.
//
// Over 400 lines: the way in and the way out are each other's mirror, for records and for matrices.
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/lanes/pack.hpp>
#include <rddl/simulator.h>
#include <rddl/values/bool_rows.hpp>
#include <rddl/values/pack_ops.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

namespace rddl {

struct Column {
    rddl_scalar scalar = RDDL_REAL;
    std::int64_t limit = 0;  // objects of its type; 0: no objects
    std::int64_t count = 0;  // values in a row
    std::int64_t first = 0;  // the values before it in a row
    std::int64_t row = 0;    // bytes into a record of the C interface
    std::int64_t block = 0;  // bytes into a block
};

template <class List>
struct ColumnTable {
    List list{};
    std::int64_t row_size = 0;     // bytes of a record of the C interface
    std::int64_t value_count = 0;  // of a row
    std::int64_t block_size = 0;   // bytes
    std::int64_t alignment = 1;    // of a block, in bytes
    bool has_bools = false;
    bool has_reals = false;
    bool has_objects = false;
};
// Columns of any problem, and of one that is known when its simulator is compiled.
using Columns = ColumnTable<std::vector<Column>>;
template <std::size_t count>
using KnownColumns = ColumnTable<std::array<Column, count>>;

// Calls visit.template operator()<T>() with the type that a scalar has in packs or scalars.
template <class L, class Visit>
RDDL_INLINE void with_type(rddl_scalar scalar, Visit&& visit) {
    if (scalar == RDDL_BOOL)
        visit.template operator()<typename L::Bool>();
    else if (scalar == RDDL_INT)
        visit.template operator()<typename L::Int>();
    else
        visit.template operator()<typename L::Real>();
}

namespace detail {

// In a role with more fluents, neighbours make one column; and more columns than that are looped
// over, not unrolled. So the compiled code does not grow with the fluents.
inline constexpr std::size_t most_apart = 16;

// Actions of packs are only read: many values at once are read faster.
template <class L>
constexpr bool have_own_columns(std::size_t fluents, rddl_role role) {
    return fluents <= most_apart && (L::width == 1 || role != RDDL_ACTION);
}

constexpr std::size_t fluent_count(const rddl_problem& problem, rddl_role role) {
    std::size_t count = 0;
    for (std::int32_t f = 0; f < problem.fluent_count; ++f)
        count += problem.fluents[f].role == role;
    return count;
}

constexpr std::int64_t size_in_row(const rddl_fluent& fluent) {
    return fluent.count * (fluent.scalar == RDDL_BOOL ? 1 : 8);
}

// Whether the second lies behind the first, in rows and in blocks, with the same kind of values.
constexpr bool are_neighbours(const rddl_fluent& first, const rddl_fluent& second) {
    return first.scalar == second.scalar && first.range_type == second.range_type &&
           first.offset + size_in_row(first) == second.offset;
}

// Calls body(first, last) with the fluents of each column.
template <class Body>
constexpr void for_each_group(const rddl_problem& problem, rddl_role role, bool are_apart,
                              Body&& body) {
    // Numbers, not pointers: with its sanitizers, g++ compares no pointer with null at compile
    // time.
    constexpr std::int32_t none = -1;
    std::int32_t first = none, last = none;
    for (std::int32_t f = 0; f < problem.fluent_count; ++f) {
        const rddl_fluent& fluent = problem.fluents[f];
        if (fluent.role != role) continue;
        if (last != none && (are_apart || !are_neighbours(problem.fluents[last], fluent))) {
            body(problem.fluents[first], problem.fluents[last]);
            first = none;
        }
        if (first == none) first = f;
        last = f;
    }
    if (last != none) body(problem.fluents[first], problem.fluents[last]);
}

constexpr std::size_t column_count(const rddl_problem& problem, rddl_role role, bool are_apart) {
    std::size_t count = 0;
    for_each_group(problem, role, are_apart,
                   [&](const rddl_fluent&, const rddl_fluent&) { ++count; });
    return count;
}

// Fills a list that is as long as the columns of the role are many.
template <class L, class List>
constexpr void lay_out(ColumnTable<List>& columns, const rddl_problem& problem, rddl_role role,
                       bool are_apart) {
    const auto round_up = [](std::int64_t a, std::int64_t unit) {
        return (a + unit - 1) / unit * unit;
    };
    std::size_t place = 0;
    const auto add = [&](const rddl_fluent& fluent, const rddl_fluent& last) {
        const bool is_object = fluent.range_type >= 0;
        const std::int64_t limit = is_object ? problem.types[fluent.range_type].object_count : 0;
        const std::int64_t size = fluent.scalar == RDDL_BOOL ? 1 : 8;
        const std::int64_t count = (last.offset - fluent.offset) / size + last.count;
        with_type<L>(fluent.scalar, [&]<class T>() {
            const std::int64_t offset = round_up(columns.block_size, alignof(T));
            columns.list[place++] = {fluent.scalar,       limit,         count,
                                     columns.value_count, fluent.offset, offset};
            columns.block_size = offset + count * static_cast<std::int64_t>(sizeof(T));
            columns.alignment = std::max(columns.alignment, static_cast<std::int64_t>(alignof(T)));
        });
        columns.value_count += count;
        columns.has_bools |= fluent.scalar == RDDL_BOOL;
        columns.has_reals |= fluent.scalar == RDDL_REAL;
        columns.has_objects |= is_object;
    };
    for_each_group(problem, role, are_apart, add);
    columns.block_size = round_up(columns.block_size, columns.alignment);
}

}  // namespace detail

// The fluents of a role, laid out in a block as C++ lays out the emitted struct. Columns that are
// not known when the simulator is compiled are looped over: the fewer, the faster.
template <class L>
Columns columns_of(const rddl_problem& problem, rddl_role role, std::int64_t row_size) {
    constexpr bool are_apart = false;
    Columns columns{.list = std::vector<Column>(detail::column_count(problem, role, are_apart)),
                    .row_size = row_size};
    detail::lay_out<L>(columns, problem, role, are_apart);
    return columns;
}
template <class L, const rddl_problem& problem, rddl_role role>
constexpr auto known_columns(std::int64_t row_size) {
    constexpr bool are_apart =
        detail::have_own_columns<L>(detail::fluent_count(problem, role), role);
    KnownColumns<detail::column_count(problem, role, are_apart)> columns{.row_size = row_size};
    detail::lay_out<L>(columns, problem, role, are_apart);
    return columns;
}

// Whether the records of single environments have bytes between or after their values.
constexpr bool has_padding(const rddl_problem& problem, rddl_role role, std::int64_t row_size) {
    std::int64_t values = 0;
    for (std::int32_t f = 0; f < problem.fluent_count; ++f) {
        const rddl_fluent& fluent = problem.fluents[f];
        if (fluent.role == role) values += detail::size_in_row(fluent);
    }
    return values != row_size;
}

// Whether some fluent of the role has so many values that compilers keep it in memory.
constexpr bool has_tables(const rddl_problem& problem, rddl_role role) {
    constexpr std::int64_t most_in_registers = 4;
    bool has = false;
    for (std::int32_t f = 0; f < problem.fluent_count; ++f)
        has |= problem.fluents[f].role == role && problem.fluents[f].count > most_in_registers;
    return has;
}

// Whether states are made where they stay, and not copied there from registers.
constexpr bool has_large_state(const rddl_problem& problem) {
    constexpr std::int64_t most_copied = 8;
    std::int64_t count = 0;
    for (std::int32_t f = 0; f < problem.fluent_count; ++f)
        if (problem.fluents[f].role == RDDL_STATE) count += problem.fluents[f].count;
    return count > most_copied;
}

// Calls visit(column) for each; known ones are constants there, if they are few.
template <class Visit>
void for_each_column(const Columns& columns, Visit&& visit) {
    for (const Column& column : columns.list) visit(column);
}
template <std::size_t count, class Visit>
RDDL_INLINE void for_each_column(const KnownColumns<count>& columns, Visit&& visit) {
    if constexpr (count > detail::most_apart)
        for (const Column& column : columns.list) visit(column);
    else
        [&]<std::size_t... i>(std::index_sequence<i...>) RDDL_INLINE_LAMBDA {
            (visit(columns.list[i]), ...);
        }
    (std::make_index_sequence<count>());
}

namespace detail {

// The type of one lane's value in a record of the C interface: all reals are double there, and all
// ints have 64 bits.
template <class T>
struct TypeInRecord {
    using type = T;
};
template <>
struct TypeInRecord<float> {
    using type = double;
};
template <>
struct TypeInRecord<std::int8_t> {
    using type = std::int64_t;
};
template <class T>
using InRecord = typename TypeInRecord<T>::type;

// Callers write true as any byte but 0.
constexpr std::byte bool_of(std::byte byte) {
    return std::byte{byte != std::byte{0}};
}
template <class Word>
RDDL_INLINE Word word_at(const std::byte* bytes) {
    Word word;
    __builtin_memcpy(&word, bytes, sizeof word);
    return word;
}
// All bits of one to seven bytes, some of them at other places: two words hold them all.
RDDL_INLINE std::uint64_t last_bytes(const std::byte* bytes, std::int64_t count) {
    if (count >= 4)
        return word_at<std::uint32_t>(bytes) | word_at<std::uint32_t>(bytes + count - 4);
    if (count >= 2)
        return word_at<std::uint16_t>(bytes) | word_at<std::uint16_t>(bytes + count - 2);
    return std::to_integer<std::uint64_t>(*bytes);
}
// Whether each of these bytes is 0 or 1.
RDDL_INLINE bool are_plain(const std::byte* bytes, std::int64_t count) {
    constexpr std::uint64_t others = 0xFEFEFEFEFEFEFEFE;
    std::uint64_t all = 0;
    std::int64_t k = 0;
    simd::Words some{};
    constexpr std::int64_t size = sizeof some;
    for (; k + size <= count; k += size) {
        simd::Words chunk;
        __builtin_memcpy(&chunk, bytes + k, sizeof chunk);
        some |= chunk;
    }
#ifdef RDDL_SIMD_AVX512
    if (count >= 8) {
        if (k < count)
            some |= (simd::Words)_mm512_maskz_loadu_epi8(~std::uint64_t{0} >> (size - (count - k)),
                                                         bytes + k);
        return _mm512_test_epi8_mask((__m512i)some, _mm512_set1_epi64(others)) == 0;
    }
#endif
    for (int i = 0; k > 0 && i < simd::lanes; ++i) all |= some[i];
    for (; k + 8 <= count; k += 8) all |= word_at<std::uint64_t>(bytes + k);
    if (k < count) all |= last_bytes(bytes + k, count - k);
    return (all & others) == 0;
}

// One number of each of the first `present` rows.
template <class T>
T read_some_numbers(const std::byte* rows, std::int64_t row_size, int present) {
    typename T::Element numbers[T::width] = {};
    for (int lane = 0; lane < present; ++lane)
        std::memcpy(&numbers[lane], rows + lane * row_size, sizeof numbers[lane]);
    return T::load(numbers);
}
template <class T>
RDDL_INLINE T read_numbers(const std::byte* rows, std::int64_t row_size, int present) {
    if constexpr (std::is_same_v<typename T::Element, float>)
        return to_float(read_numbers<Lanes<double, T::width>>(rows, row_size, present));
    else if constexpr (std::is_same_v<typename T::Element, std::int8_t>)
        return read_numbers<Lanes<std::int64_t, T::width>>(rows, row_size, present);
    else if (present == T::width)
        return T::load_apart(rows, row_size);
    else
        return read_some_numbers<T>(rows, row_size, present);
}
// Makes a value of the lanes of a number of records.
template <class T, class Lanes>
RDDL_INLINE T from_records(const Lanes& numbers) {
    if constexpr (std::is_same_v<typename T::Element, float>)
        return to_float(numbers);
    else
        return numbers;
}
// Reads rows of two numbers.
template <class T>
RDDL_INLINE void read_pairs(const std::byte* rows, T* values) {
    Lanes<InRecord<typename T::Element>, T::width> columns[2];
    for (int p = 0; p < columns[0].part_count; ++p) {
        simd::Vector<InRecord<typename T::Element>> halves[2];
        __builtin_memcpy(halves, rows + p * static_cast<int>(sizeof halves), sizeof halves);
        simd::separate_pairs(halves[0], halves[1]);
        columns[0].part[p] = halves[0];
        columns[1].part[p] = halves[1];
    }
    for (int i = 0; i < 2; ++i) values[i] = from_records<T>(columns[i]);
}

// Callers' rows come from memory, and the loads that transpose them hide from hardware prefetchers
// that they are read one after the other.
RDDL_INLINE void prefetch_rows(const std::byte* next, std::int64_t size) {
    constexpr std::int64_t distance = 2048, line = 64;
    for (std::int64_t k = distance; k < distance + size; k += line) __builtin_prefetch(next + k);
}

// Calls body with a constant that is this count, if rows of so many ints are transposed as bytes;
// else returns nothing.
template <class Body>
RDDL_INLINE auto with_byte_row(std::int64_t count, Body&& body)
    -> decltype(body(std::integral_constant<int, 2>())) {
    if (count == 2) return body(std::integral_constant<int, 2>());
    if (count == 4) return body(std::integral_constant<int, 4>());
    if (count == 8) return body(std::integral_constant<int, 8>());
    return {};
}
// Reads rows of such ints and nothing else, which are byte ints in the block. `any` gets the bits
// of all.
template <class T>
RDDL_INLINE bool read_rows_of_byte_ints(const std::byte* rows, std::int64_t row_size,
                                        std::int64_t count, T* values, simd::Words& any) {
    if (row_size != count * static_cast<std::int64_t>(sizeof(std::int64_t))) return false;
    return with_byte_row(count, [&]<int n>(std::integral_constant<int, n>) RDDL_INLINE_LAMBDA {
        simd::ByteInts columns[n];
        simd::narrow_rows(rows, columns, any);
        for (int i = 0; i < n; ++i) values[i].part[0] = columns[i];
        return true;
    });
}
// Reads `count` columns, at most as many as a register has lanes, of whole blocks.
template <class T>
RDDL_INLINE void read_columns(const std::byte* rows, std::int64_t row_size, std::int64_t count,
                              T* values) {
    using Value = InRecord<typename T::Element>;
    if constexpr (std::is_same_v<typename T::Element, std::int8_t>) {
        simd::Words any{};
        if (read_rows_of_byte_ints(rows, row_size, count, values, any)) return;
    }
    if (count == 2 && row_size == 2 * sizeof(Value)) return read_pairs(rows, values);
    Lanes<Value, T::width> columns[simd::lanes];
    for (int p = 0; p < columns[0].part_count; ++p) {
        simd::Vector<Value> square[simd::lanes];
        simd::load_transposed(rows + p * simd::lanes * row_size, row_size, static_cast<int>(count),
                              square);
        for (int i = 0; i < simd::lanes; ++i) columns[i].part[p] = square[i];
    }
    for (int i = 0; i < count; ++i) values[i] = from_records<T>(columns[i]);
}
template <class T>
RDDL_INLINE void write_numbers(const T& values, std::byte* rows, std::int64_t row_size,
                               int present) {
    if constexpr (std::is_same_v<typename T::Element, float>) {
        write_numbers(to_double(values), rows, row_size, present);
    } else if constexpr (std::is_same_v<typename T::Element, std::int8_t>) {
        write_numbers(widened(values), rows, row_size, present);
    } else if (present == T::width && row_size == 8) {
        values.store(rows);
    } else {
        typename T::Element numbers[T::width];
        values.store(numbers);
        for (int lane = 0; lane < present; ++lane)
            std::memcpy(rows + lane * row_size, &numbers[lane], sizeof numbers[lane]);
    }
}

template <class T>
const T* values_in(const std::byte* block, const Column& column) {
    return reinterpret_cast<const T*>(block + column.block);
}
template <class T>
T* values_in(std::byte* block, const Column& column) {
    return reinterpret_cast<T*>(block + column.block);
}

#ifdef RDDL_SIMD_AVX512
// Two squares of words.
inline constexpr std::int64_t most_short_words = 2 * simd::lanes;

// Whether records are so short that each is read once, whatever lies in it. Those of bools alone
// have quicker ways (bool_rows.hpp), and so have those of one column.
template <std::size_t count>
RDDL_INLINE bool are_short(const KnownColumns<count>& columns) {
    constexpr std::int64_t most_bools = 8;
    std::int64_t bools = 0, numbers = 0;
    for_each_column(columns, [&](const Column& column) RDDL_INLINE_LAMBDA {
        (column.scalar == RDDL_BOOL ? bools : numbers) += column.count;
    });
    return count > 1 && numbers > 0 && bools <= most_bools &&
           columns.row_size <= 8 * most_short_words;
}
inline bool are_short(const Columns&) {
    return false;
}
// The words of short records of whole blocks become their values.
template <class L, class List>
RDDL_INLINE void read_short_records(L, const ColumnTable<List>& columns, const std::byte* rows,
                                    std::byte* block) {
    Lanes<std::uint64_t, L::width> words[most_short_words];
    const std::int64_t word_count = columns.row_size / 8;
    for (std::int64_t k = 0; k < word_count; k += simd::lanes)
        read_columns(rows + 8 * k, columns.row_size,
                     std::min<std::int64_t>(simd::lanes, word_count - k), words + k);
    for_each_column(columns, [&](const Column& column) RDDL_INLINE_LAMBDA {
        with_type<L>(column.scalar, [&]<class T>() RDDL_INLINE_LAMBDA {
            T* const values = values_in<T>(block, column);
            const std::int64_t first = column.row / 8;
            for (std::int64_t k = 0; k < column.count; ++k) {
                if constexpr (std::is_same_v<T, typename L::Bool>) {
                    const std::int64_t byte = column.row + k;
                    values[k] = ints_of(words[byte / 8] & Lanes<std::uint64_t, L::width>(
                                                              std::uint64_t{0xFF}
                                                              << byte % 8 * 8)) != std::int64_t{0};
                } else if constexpr (std::is_same_v<typename T::Element, float>) {
                    values[k] = to_float(real_of_bits(words[first + k]));
                } else if constexpr (std::is_same_v<typename T::Element, std::int8_t>) {
                    values[k] = ints_of(words[first + k]);
                } else {
                    values[k] = same_bits<typename T::Element>(words[first + k]);
                }
            }
        });
    });
}
#endif

// Fewer columns are gathered.
#ifdef RDDL_SIMD_AVX512
inline constexpr std::int64_t least_transposed = 2;
#else
inline constexpr std::int64_t least_transposed = simd::lanes;
#endif

}  // namespace detail

// An object of more is no byte int.
inline constexpr std::int64_t most_byte_objects = 128;

// Whether records are nothing but objects that are transposed as byte ints. Whole blocks of them
// are read as they are checked, into Blocks::actions.
template <class L, class List>
constexpr bool are_read_when_checked(const ColumnTable<List>& columns) {
    if (!has_byte_ints<L> || columns.list.size() != 1) return false;
    const Column& column = columns.list.front();
    return column.limit > 0 && column.limit <= most_byte_objects &&
           columns.row_size == 8 * column.count &&
           detail::with_byte_row(column.count, [](auto) { return true; });
}

// ---------------------------------------------------------------------------- single values

// Writes the first `present` lanes.
inline void write_reals(double value, double* to, int) {
    *to = value;
}
template <class R, int n>
void write_reals(const Lanes<R, n>& values, double* to, int present) {
    detail::write_numbers(values, reinterpret_cast<std::byte*>(to), 8, present);
}

// A byte of 0 or 1 each.
template <int n>
RDDL_INLINE void write_flags(Mask<n> mask, std::uint8_t* flags, int present) {
    simd::store_as_bytes<n>(mask.bits, flags, present);
}
inline void write_flags(bool value, std::uint8_t* flags, int) {
    *flags = value;
}

// ---------------------------------------------------------------------------------- records

// Whether every bool of a record is 0 or 1, as compilers want it.
template <class List>
RDDL_INLINE bool has_plain_bools(const ColumnTable<List>& columns, const std::byte* row) {
    if (!columns.has_bools) return true;
    // Neighbouring columns are one run of bytes.
    std::int64_t first = 0, end = 0;
    bool are_plain = true;
    for_each_column(columns, [&](const Column& column) RDDL_INLINE_LAMBDA {
        if (column.scalar != RDDL_BOOL) return;
        if (column.row != end) {
            are_plain &= detail::are_plain(row + first, end - first);
            first = column.row;
        }
        end = column.row + column.count;
    });
    are_plain &= detail::are_plain(row + first, end - first);
    return are_plain;
}

// Reads the first `present` lanes; the others become zero.
template <class List>
void read_records(Scalar, const ColumnTable<List>& columns, const std::byte* rows, int,
                  std::byte* block) {
    for_each_column(columns, [&](const Column& column) RDDL_INLINE_LAMBDA {
        const std::byte* const from = rows + column.row;
        std::byte* const to = block + column.block;
        if (column.scalar != RDDL_BOOL) {
            std::memcpy(to, from, static_cast<std::size_t>(8 * column.count));
        } else {
            for (std::int64_t k = 0; k < column.count; ++k) to[k] = detail::bool_of(from[k]);
        }
    });
}
template <class L, class List>
requires(L::width > 1) RDDL_INLINE
    void read_records(L, const ColumnTable<List>& columns, const std::byte* rows, int present,
                      std::byte* block) {
    constexpr int n = L::width;
#ifdef RDDL_SIMD_AVX512
    if (present == n && detail::are_short(columns))
        return detail::read_short_records(L{}, columns, rows, block);
#endif
    const auto read = [&]<class T>(const Column& column, T* values) RDDL_INLINE_LAMBDA {
        const std::byte* const first = rows + column.row;
        std::int64_t k = 0;
        for (; present == n && k + simd::lanes <= column.count; k += simd::lanes)
            detail::read_columns(first + 8 * k, columns.row_size, simd::lanes, values + k);
        const std::int64_t rest = column.count - k;
        if (present == n && __builtin_constant_p(rest) && rest >= detail::least_transposed) {
            detail::read_columns(first + 8 * k, columns.row_size, rest, values + k);
            k += rest;
        }
        for (; k < column.count; ++k)
            values[k] = detail::read_numbers<T>(first + 8 * k, columns.row_size, present);
    };
    for_each_column(columns, [&](const Column& column) RDDL_INLINE_LAMBDA {
        with_type<L>(column.scalar, [&]<class T>() RDDL_INLINE_LAMBDA {
            T* const values = detail::values_in<T>(block, column);
            if constexpr (std::is_same_v<T, typename L::Bool>)
                read_bools(rows + column.row, columns.row_size, present, column.count, values);
            else
                read(column, values);
        });
    });
}

inline void write_records(Scalar, const Columns& columns, const std::byte* block, std::byte* rows,
                          int) {
    if (columns.row_size > 0) std::memcpy(rows, block, static_cast<std::size_t>(columns.row_size));
}
template <class L>
requires(L::width > 1) void write_records(L, const Columns& columns, const std::byte* block,
                                          std::byte* rows, int present) {
    const auto write = [&]<class T>(const Column& column, const T* values) {
        for (std::int64_t k = 0; k < column.count; ++k)
            detail::write_numbers(values[k], rows + column.row + 8 * k, columns.row_size, present);
    };
    for (const Column& column : columns.list)
        with_type<L>(column.scalar, [&]<class T>() {
            const T* const values = detail::values_in<T>(block, column);
            if constexpr (std::is_same_v<T, typename L::Bool>)
                write_bools(values, column.count, rows + column.row, columns.row_size, present);
            else
                write(column, values);
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
template <class L, class List>
void read_record(L, const ColumnTable<List>& columns, const std::byte* row, std::byte* block,
                 int lane) {
    for (const Column& column : columns.list)
        with_type<L>(column.scalar, [&]<class T>() {
            T* const values = detail::values_in<T>(block, column);
            for (std::int64_t k = 0; k < column.count; ++k) {
                using Number = decltype(get_lane(values[k], lane));
                detail::InRecord<Number> value;
                const std::byte* const from =
                    row + column.row + k * static_cast<std::int64_t>(sizeof value);
                if constexpr (std::is_same_v<Number, bool>)
                    value = *from != std::byte{0};
                else
                    std::memcpy(&value, from, sizeof value);
                set_lane(values[k], lane, static_cast<Number>(value));
            }
        });
}

// The records of single environments whose reals have another width.
template <class List>
RDDL_INLINE void read_records(ScalarOf<float>, const ColumnTable<List>& columns,
                              const std::byte* rows, int, std::byte* block) {
    for_each_column(columns, [&](const Column& column) RDDL_INLINE_LAMBDA {
        const std::byte* const from = rows + column.row;
        std::byte* const to = block + column.block;
        if (column.scalar == RDDL_BOOL) {
            for (std::int64_t k = 0; k < column.count; ++k) to[k] = detail::bool_of(from[k]);
        } else if (column.scalar == RDDL_INT) {
            std::memcpy(to, from, static_cast<std::size_t>(8 * column.count));
        } else {
            for (std::int64_t k = 0; k < column.count; ++k) {
                double real;
                std::memcpy(&real, from + 8 * k, sizeof real);
                const float rounded = to_float(real);
                std::memcpy(to + 4 * k, &rounded, sizeof rounded);
            }
        }
    });
}
inline void write_records(ScalarOf<float> lanes, const Columns& columns, const std::byte* block,
                          std::byte* rows, int) {
    write_record(lanes, columns, block, 0, rows);
}

// ------------------------------------------------------------------------ matrices of reals

namespace detail {

// One number of each row of a whole block, which is quicker than lane by lane.
template <class T, class Number>
RDDL_INLINE T read_whole(const Number* number, std::int64_t row_size) {
    typename T::Element elements[T::width];
    if (row_size == 1)
        for (int lane = 0; lane < T::width; ++lane)
            elements[lane] = static_cast<typename T::Element>(number[lane]);
    else
        for (int lane = 0; lane < T::width; ++lane, number += row_size)
            elements[lane] = static_cast<typename T::Element>(*number);
    return T::load(elements);
}
template <class T, class Number>
RDDL_INLINE void write_whole(const T& values, Number* number, std::int64_t row_size) {
    typename T::Element elements[T::width];
    values.store(elements);
    Number numbers[T::width];
    for (int lane = 0; lane < T::width; ++lane) numbers[lane] = static_cast<Number>(elements[lane]);
    for (int lane = 0; lane < T::width; ++lane, number += row_size) *number = numbers[lane];
}

template <class T>
inline constexpr bool is_real_lanes = false;
template <class R, int n>
inline constexpr bool is_real_lanes<Lanes<R, n>> = std::is_floating_point_v<R>;

}  // namespace detail

// Row-major, `value_count` numbers a row: bools are 0 and 1, objects their index.
template <class L, class Number>
void read_values(L, const Columns& columns, const Number* rows, int present, std::byte* block) {
    for (const Column& column : columns.list)
        with_type<L>(column.scalar, [&]<class T>() {
            T* const values = detail::values_in<T>(block, column);
            for (std::int64_t k = 0; k < column.count; ++k) {
                const Number* number = rows + column.first + k;
                if constexpr (detail::is_real_lanes<T>)
                    if (present == T::width) {
                        values[k] = detail::read_whole<T>(number, columns.value_count);
                        continue;
                    }
                for (int lane = 0; lane < present; ++lane, number += columns.value_count) {
                    using Value = decltype(get_lane(values[k], lane));
                    if constexpr (std::is_same_v<Value, bool>)
                        set_lane(values[k], lane, *number > Number{0.5});
                    else if constexpr (std::is_integral_v<Value>)
                        set_lane(values[k], lane,
                                 static_cast<Value>(round(static_cast<double>(*number))));
                    else
                        set_lane(values[k], lane, static_cast<Value>(*number));
                }
            }
        });
}
// The rows of the lanes [begin, end).
template <class L, class Number>
void write_values(L, const Columns& columns, const std::byte* block, Number* rows, int begin,
                  int end) {
    for (const Column& column : columns.list)
        with_type<L>(column.scalar, [&]<class T>() {
            const T* const values = detail::values_in<T>(block, column);
            for (std::int64_t k = 0; k < column.count; ++k) {
                Number* number = rows + column.first + k;
                if constexpr (detail::is_real_lanes<T>)
                    if (begin == 0 && end == T::width) {
                        detail::write_whole(values[k], number, columns.value_count);
                        continue;
                    }
                for (int lane = begin; lane < end; ++lane, number += columns.value_count)
                    *number = static_cast<Number>(get_lane(values[k], lane));
            }
        });
}

// -------------------------------------------------------------------------------- in blocks

// Takes over another block's values where the mask holds, without jumps.
template <class L, class List>
RDDL_INLINE void select_values(L, const ColumnTable<List>& columns, typename L::Bool mask,
                               const std::byte* from, std::byte* block) {
    for_each_column(columns, [&](const Column& column) RDDL_INLINE_LAMBDA {
        with_type<L>(column.scalar, [&]<class T>() RDDL_INLINE_LAMBDA {
            const T* const theirs = detail::values_in<T>(from, column);
            T* const ours = detail::values_in<T>(block, column);
            for (std::int64_t k = 0; k < column.count; ++k)
                ours[k] = select(mask, theirs[k], ours[k]);
        });
    });
}
// The same with jumps, as most masks are empty or full.
template <class R, class List>
void merge(ScalarOf<R>, const ColumnTable<List>& columns, bool mask, const std::byte* from,
           std::byte* block) {
    if (mask && columns.block_size > 0)
        std::memcpy(block, from, static_cast<std::size_t>(columns.block_size));
}
template <class L, class List>
requires(L::width > 1) void merge(L, const ColumnTable<List>& columns, typename L::Bool mask,
                                  const std::byte* from, std::byte* block) {
    if (all(mask) && columns.block_size > 0) {
        std::memcpy(block, from, static_cast<std::size_t>(columns.block_size));
        return;
    }
    if (any(mask)) select_values(L{}, columns, mask, from, block);
}

// Each lane gets the values of the first one.
template <class L>
void repeat_lane(L, const Columns& columns, std::byte* block) {
    for (const Column& column : columns.list)
        with_type<L>(column.scalar, [&]<class T>() {
            T* const values = detail::values_in<T>(block, column);
            for (std::int64_t k = 0; k < column.count; ++k) values[k] = T(get_lane(values[k], 0));
        });
}

}  // namespace rddl
