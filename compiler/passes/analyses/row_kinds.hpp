// Objects that have the same row of constants are of one kind, so that a table has fewer rows.
#pragma once

#include "ir/ir.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace rddlc::passes {

// A row for each object, in row-major order.
struct Rows {
    std::size_t cases;  // elements of each row
    std::vector<ir::Value> values;
    std::vector<std::size_t> reached;  // by object: how many of its row's elements are read

    std::span<const ir::Value> reached_by(std::size_t object) const {
        return std::span(values).subspan(object * cases, reached[object]);
    }
};

// Objects of one kind have the same row, as far as both reach.
struct RowKinds {
    std::vector<std::size_t> examples;  // of each kind, the object that reaches furthest
    std::vector<ir::Value> of_objects;  // ints
};

// Nothing if the objects are of too many kinds.
std::optional<RowKinds> kinds_of(const Rows& rows);

}  // namespace rddlc::passes
