// Loops over the objects that few bools affect look up what the only true bool does.
//
//     for x in cell, as words, affected by state.at
//         next.at[x] = select(action.go & element(state.at, WEST[x]), sample bernoulli@0[x](P[x]),
//                             ~action.go & state.at[x])
//                                       =>
//     for x in cell, as words, affected by state.at, moves at-moves[action.go]
//         ...
//
// Mostly such a table is the place of one thing. For each place and the bools that choose, which
// have no parameters, the loop is evaluated here: none of its bools is true, or one is, or is if
// its draw is. One environment looks that up, and runs the loop where it is not so, or where
// several bools are true. Nothing else changes, and the draw is the same.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program look_up_moves(ir::Program program, Report& report);

}  // namespace rddlc::passes
