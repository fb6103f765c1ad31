// Sines and cosines of a step are computed together.
//
//     next.x = state.x + cos(state.a)               fill scratch.angles = together(cos(state.a),
//     next.y = state.y + sin(state.a)                                              sin(state.a),
//     reward: cos(state.b + action.turn)      =>             cos(state.b + action.turn), ...)
//                                                   next.x = state.x + scratch.angles[0]
//                                                   next.y = state.y + scratch.angles[1]
//                                                   reward: scratch.angles[2]
//
// One environment has them in the lanes of a vector register. Only those count that every step
// needs, whose angles are known before it, and which do not depend on a loop. Terminations and
// invariants, which are tested in the new state, have calls of their own.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program group_angles(ir::Program program, Report& report);

}  // namespace rddlc::passes
