// An expression that depends on the interval of a number becomes a binary search among the ends of
// the intervals.
//
//     sum[s in segment](SLOPE[s] * real(state.x >= LEFT[s] && state.x < RIGHT[s]))
//                                          =>
//     x-values[search(x-breaks, state.x)]
//
// If the terms are not constant, but at most one object counts in each interval, that object is
// looked up, and its term is computed:
//
//     sum[s in segment](real(state.x >= LEFT[s] && state.x < RIGHT[s]) * state.v[s])
//                                          =>
//     select(x-is-there[k], state.v[x-object[k]], 0.0)    with k = search(x-breaks, state.x)
//
// Values at the ends, and for nan, are those of the comparisons.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program search_intervals(ir::Program program, Report& report);

}  // namespace rddlc::passes
