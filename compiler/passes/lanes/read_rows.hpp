// The terms of an exists or forall over bools lie in rows, so that a loop can be evaluated for
// several objects at once (evaluate_together.hpp).
//
//     for y in row
//         scratch.free[y] = forall[j in part](OPEN[y, j] || !state.full[c, NEXT[y, j]])
//                                         =>
//     for y in row
//         scratch.free[y] = forall[j in part](free-row[j, y]
//                                             || !element(state.full[c], free-places[j, y]))
//
// Bools that only constants decide become rows of a table, and others whose place constants choose
// are read by rows of places. So each term is a register of bools for all objects of the innermost
// loop, and the aggregation combines registers. All of a loop is rewritten or nothing.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program read_rows(ir::Program program, Report& report);

}  // namespace rddlc::passes
