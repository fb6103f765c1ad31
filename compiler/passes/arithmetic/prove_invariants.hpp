// A state invariant that every step keeps need not be tested in each new state.
//
//     invariant: forall[c in car](state.speed[c] <= FASTEST[c])
//     next.speed[c] = min(FASTEST[c], state.speed[c] + ...)
//
// Only with --fast-math, where no speed is nan: that would violate the invariant.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program prove_invariants(ir::Program program, Report& report);

}  // namespace rddlc::passes
