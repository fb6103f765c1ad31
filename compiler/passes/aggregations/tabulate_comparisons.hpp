// Comparisons of ints of the state, in aggregations whose rows differ, are made once for each int.
//
//     for s in spring
//         scratch.safe[s] = forall[e in row(NEAR-rows, s)](!(state.fish[NEAR-s2[e]] == 1))
//                                       =>
//     for s in spring
//         scratch.fish-bools[s] = state.fish[s] == 1
//     for s in spring
//         scratch.safe[s] = forall[e in row(NEAR-rows, s)](!scratch.fish-bools[NEAR-s2[e]])
//
// This is done where count_bits.hpp then tests the bools of a row in words.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program tabulate_comparisons(ir::Program program, Report& report);

}  // namespace rddlc::passes
