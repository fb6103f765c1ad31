// Fills tables so that loops can be evaluated for several objects at once (evaluate_together.hpp).
//
// What a loop aggregates for each of its objects is computed before it:
//
//     for r in reservoir                              for r in reservoir
//         next.level[r] = sample normal@0[r](0, 1)        level-part[r] = sum[e in row](flow[e])
//                         + sum[e in row](flow[e])  =>  for r in reservoir
//                                                         next.level[r] = sample normal@0[r](0, 1)
//                                                                         + level-part[r]
//
// The terms of a sum of reals are computed before they are added:
//
//     sum[r in reservoir](select(next.level[r] > 9, cost[r], 0))
//                                                 =>  for r in reservoir
//                                                         reward-terms[r] = select(...)
//                                                     sum[r in reservoir](reward-terms[r])
//
// Nothing is computed more often than before, so aggregations in branches stay there, as do those
// that may fault.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program separate_aggregations(ir::Program program, Report& report);

}  // namespace rddlc::passes
