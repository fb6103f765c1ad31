// Sums over the own row that each of several objects has in a table.
#pragma once

#include <rddl/lanes/simd_moves.hpp>
#include <rddl/object_lanes/objects.hpp>
#include <rddl/values/reductions.hpp>

#include <cstddef>
#include <tuple>
#include <type_traits>

namespace rddl {

// The sum of the row of each object, one element after the other. Registers hold as many rows as
// they have lanes, and transpose them.
template <class Table>
RDDL_INLINE auto sum_of_row(const Table& table, OneObject object) {
    const auto& row = (&detail::first_part<1>(table))[object.place];
    using Real = std::remove_cvref_t<decltype(row[0])>;
    return sum<Real>(static_cast<Index>(row.size()),
                     [&](Index k) RDDL_INLINE_LAMBDA { return row[static_cast<std::size_t>(k)]; });
}
template <class Table, int n>
RDDL_INLINE auto sum_of_row(const Table& table, const SomeObjects<n>& objects) {
    const auto* const rows = &detail::first_part<1>(table);
    using Row = std::remove_cvref_t<decltype(*rows)>;
    using R = std::remove_cvref_t<decltype((*rows)[0])>;
    constexpr auto size = static_cast<Index>(std::tuple_size_v<Row>);
    Lanes<R, n> total{R(0.0)};
    if constexpr (sizeof(R) == 8 && n % simd::lanes == 0 && size % simd::lanes == 0) {
        if (objects.count == n) {
            for (int p = 0; p < total.part_count; ++p)
                for (Index first = 0; first < size; first += simd::lanes) {
                    simd::Reals columns[simd::lanes];
                    simd::load_transposed(
                        reinterpret_cast<const std::byte*>(&rows[objects.first + p * simd::lanes]
                                                                [static_cast<std::size_t>(first)]),
                        sizeof(Row), simd::lanes, columns);
                    for (const simd::Reals& column : columns) total.part[p] += column;
                }
            return total;
        }
    }
    for (Index k = 0; k < size; ++k) total = total + at(table, objects, k);
    return total;
}

}  // namespace rddl
