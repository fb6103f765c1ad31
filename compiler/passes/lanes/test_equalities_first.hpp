// What has to hold beside an equality of reals is evaluated where the equality holds, which is
// hardly ever: in loops over several objects and in packs, where no lane needs it, it is skipped.
// The heuristic is that of T. Ball and J. Larus, Branch Prediction for Free, PLDI 1993, section 4
// (opcodes).
//
//     state.d == 0.0 && X[b] <= maximum(state.x, state.y) && X[b] >= minimum(state.x, state.y)
//     =>  select mostly first(state.d != 0.0, false,
//                             X[b] <= maximum(state.x, state.y) && X[b] >= minimum(state.x,
//                             state.y))
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program test_equalities_first(ir::Program program, Report& report);

}  // namespace rddlc::passes
