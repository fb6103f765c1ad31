// Where few bools of a table are true, they are visited, and not all that might be.
//
//     before:  for l in location
//                  next.at[l] = exists[k in location](move[k, l] && state.at[k] && ROAD[k, l])
//     after:   for l in location
//                  next.at[l] = false
//              for true state.at[k]
//                  for entry in ROAD-rows[k] .. ROAD-rows[k + 1]
//                      next.at[ROAD-l[entry]] = true where move[k, ROAD-l[entry]]
//
// A table that keeps its elements, or a constant, but where such conditions choose a value is
// marked in place; another aggregation gets a table of its own. What the visits of one table read
// is known before the step, so all are made together.
//
// Few are those of which the initial state has few, as the place of a vehicle: another state has
// the same values and takes longer. It is done where the rest reads a table so large that loops
// over words of bools do not read it (passes/lanes/read_places.hpp).
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program visit_true(ir::Program program, Report& report);

}  // namespace rddlc::passes
