// Aggregations to which at most one object contributes: what index_directly and search_intervals
// have in common.
#pragma once

#include "ir/ir.hpp"
#include "passes/aggregations/only_object.hpp"
#include "passes/analyses/decisive.hpp"

#include <functional>
#include <optional>

namespace rddlc::passes {

// Finds the object of a variable that fulfils a condition, if at most one can. May add constant
// tables to the program, and nodes by its builder.
using FindOnlyObject = std::function<std::optional<OnlyObject>(ir::Program&, ir::Builder&,
                                                               const Condition&, ir::VariableId)>;

// If an aggregation has its neutral value except for the object that is found, its body for that
// object replaces it; a sum of reals still begins with 0.0. Draws, and fallible expressions, with a
// place of their own for each object stay.
ir::Program take_only_objects(ir::Program program, const FindOnlyObject& find);

}  // namespace rddlc::passes
