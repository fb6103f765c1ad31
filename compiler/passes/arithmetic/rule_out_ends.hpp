// Conditions that end an episode do not hold in a step.
//
//     termination: state.x < -2.4 || state.x > 2.4
//     reward: select(state.x < -2.4 || state.x > 2.4, 0.0, 1.0)
//                                   =>
//     reward: 1.0
//
// An episode whose state is terminal is over, also at its start and in a state that a caller has
// set, so that no step leaves such a state. Invariants are not tested there.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program rule_out_ends(ir::Program program, Report& report);

}  // namespace rddlc::passes
