// Sets of assignments of objects to loop indices: which entries of a table count.
#pragma once

#include "ir/ir.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rddlc::passes {

// An axis of a relation: a loop index, and how many values it has.
struct Axis {
    ir::VariableId variable;
    std::int64_t size;
    auto operator<=>(const Axis&) const = default;
};

// A set of tuples, each held as its row-major index over the axes; sorted, each once. The axes are
// sorted by variable, unless `ordered` gave them another order. Over no axes: true (one empty
// tuple) or false (no tuple).
struct Relation {
    std::vector<Axis> axes;
    std::vector<std::int64_t> tuples;

    bool has(ir::VariableId variable) const;
    std::int64_t count() const { return static_cast<std::int64_t>(tuples.size()); }
};

// The number of possible tuples; nothing if it is too large for an index.
std::optional<std::int64_t> volume(std::span<const Axis> axes);

// The values of a tuple, one for each axis.
std::vector<std::int64_t> values_of(std::int64_t tuple, std::span<const Axis> axes);
std::int64_t tuple_of(std::span<const std::int64_t> values, std::span<const Axis> axes);

// The same tuples by axes in this order. The order must hold all axes.
Relation ordered(const Relation& relation, std::vector<Axis> axes);

// The tuples of the axes of both whose parts are in `a` and in `b`. Where these would be too many:
// a superset, the smaller of the two.
Relation join(const Relation& a, const Relation& b);

// The tuples whose parts are in `a` or in `b`; nothing if these are too many.
std::optional<Relation> unite(const Relation& a, const Relation& b);

// The parts that some value of `variable` completes to a tuple.
Relation project(const Relation& relation, ir::VariableId variable);

}  // namespace rddlc::passes
