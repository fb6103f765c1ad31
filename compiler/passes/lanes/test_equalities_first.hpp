// Other conditions of a conjunction wait for an equality of reals, which hardly ever holds: loops
// over several objects and packs skip them where no lane needs them. The heuristic is that of T.
// Ball and J. Larus, Branch Prediction for Free, PLDI 1993, section 4 (opcodes).
//
//     state.d == 0.0 && X[b] <= state.most && X[b] >= state.least
//     =>  select mostly first(state.d != 0.0, false, X[b] <= state.most && X[b] >= state.least)
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program test_equalities_first(ir::Program program, Report& report);

}  // namespace rddlc::passes
