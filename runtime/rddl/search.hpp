// Binary search in sorted tables.
#pragma once

#include <rddl/lane.hpp>
#include <rddl/ops.hpp>

#include <cstdint>
#include <tuple>

namespace rddl {

// How many entries of the table are at most the value; 0 if it is nan. The number of steps depends
// on the size of the table only, so that all lanes take the same ones.
template <class Int, class Table, class Value>
constexpr Int search(const Table& table, Value value) {
    Int count{0};
    for (Index length = std::tuple_size_v<Table>; length > 0; length /= 2) {
        const Index half = (length + 1) / 2;
        const auto fits = at(table, wrap_add(count, Int{half - 1})) <= value;
        count = select(fits, wrap_add(count, Int{half}), count);
    }
    return count;
}

}  // namespace rddl
