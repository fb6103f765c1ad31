// Where few bools of a table are true, they are visited, and not all that might be.
//
//     before:  for l in location
//                  next.at[l] = exists[k in location](move[k, l] && state.at[k] && ROAD[k, l])
//     after:   fill scratch.at-any over true[k in location](state.at[k])
//                  for entry in ROAD-rows[k] .. ROAD-rows[k + 1]
//                      scratch.at-any[ROAD-l[entry]] ||= move[k, ROAD-l[entry]]
//              for l in location
//                  next.at[l] = scratch.at-any[l]
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
