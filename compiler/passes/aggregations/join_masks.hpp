// Where few bools of a row are true, and ints choose what they reach, masks are looked up.
//
//     before:  for i in robot
//                  for x in cell
//                      next.at[i, x] = exists[y in cell](state.at[i, y] && NEAR[go[i], y, x])
//     after:   for i in robot
//                  spread next.at[i] = union[at-masks[go[i]]](bits(state.at[i], 0))
//
// A mask has a bit for each x: those that one y reaches by one choice. So a robot that moves takes
// a look-up, and not one for each pair of cells. Few are those of which the initial state has few:
// another state has the same values and takes longer. Rows have at most 64 elements.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program join_masks(ir::Program program, Report& report);

}  // namespace rddlc::passes
