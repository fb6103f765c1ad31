// A bound of a number of the state is not tested where every step keeps it and another one is
// tested.
//
//     invariant: forall[c in car](state.speed[c] >= 0.0 && state.speed[c] <= 9.0)
//     next.speed[c] = max(0.0, state.speed[c] + ...)
//                                   =>
//     invariant: forall[c in car](state.speed[c] <= 9.0)
//
// The other bound also finds a speed that is nan. Simulators test invariants in states that a step
// has made, and in no others.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program shorten_invariants(ir::Program program, Report& report);

}  // namespace rddlc::passes
