// A quantifier over different objects with equal values counts the objects of each value.
//
//     exists[d in die](exists[e in die](exists[f in die](d != e && d != f && e != f &&
//             state.v[d] == state.v[e] && state.v[d] == state.v[f])))
//                                       =>
//     bit_and(sum[o in die](v-field[state.v[o]]) + 5 * 0x111111, 8 * 0x111111) != 0
//
// An Int has a field of bits for each value (value_counts.hpp). Of two groups, such as three
// objects of one value and two others of one value, each has a value of its own, or one value has
// all. Where a loop around the quantifier gives one of the objects, its value is looked at alone.
// A forall is the same of what is not true. Only where nothing draws or faults.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program count_equals(ir::Program program, Report& report);

}  // namespace rddlc::passes
