// The step's functions of whole tables are called now, if the instance fixes what they are given.
//
//     for r in axis                                        next.x = x + FACTOR[0, 1]
//         for c in axis
//             scratch.matrix[r, c] = COV[r, c]         =>
//     fill scratch.factor = cholesky(scratch.matrix)
//     next.x = x + scratch.factor[0, 1]
//
// The evaluator calls the runtime's own functions, in doubles. If one of them faults, all calls
// stay, as do those of the reward and of conditions. Without calls, packs of environments can be
// stepped.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program tabulate_calls(ir::Program program, Report& report);

}  // namespace rddlc::passes
