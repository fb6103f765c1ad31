// Fills tables so that loops can be evaluated for several objects at once (evaluate_together.hpp).
//
// An aggregation that a loop makes for each of its objects is computed before the loop:
//
//     for t in tank                                   for t in tank
//         next.level[t] = sample normal@0[t](0, 1)        level-part[t] = sum[e in row](flow[e])
//                         + sum[e in row](flow[e])  =>  for t in tank
//                                                         next.level[t] = sample normal@0[t](0, 1)
//                                                                         + level-part[t]
//
// The terms of a sum of reals are computed before they are added:
//
//     sum[t in tank](select(next.level[t] > 9, cost[t], 0))
//                                                 =>  for t in tank
//                                                         reward-terms[t] = select(...)
//                                                     sum[t in tank](reward-terms[t])
//
// So are the bools of an exists or forall.
//
// Aggregations in branches stay there, unless the branch or its condition draws, the action does
// not make the branch rare, and they take no longer than a mispredicted jump. So do those that may
// fault. So no expensive term is computed more often than before, except those of an exists or
// forall behind the first that decides.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program separate_aggregations(ir::Program program, Report& report);

}  // namespace rddlc::passes
