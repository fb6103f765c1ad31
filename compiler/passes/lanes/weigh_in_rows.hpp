// The weights of a draw over 8 objects lie in a row for each draw, so that one environment has
// them in the lanes of a register (evaluate_together.hpp):
//
//     for c in area
//         for p in person
//             weights[c, p] = GAIN[p, c, sum[n in number](int(state.known[c, n]))]
//     for p in person
//         scratch.visits[p] = sample discrete@0[p][c in area](weights[c, p]
//                                                             / sum[a in area](weights[a, p]))
//                                         =>
//     for p in person
//         for c in area
//             row[p, c] = select(element(state.known, places[c]) && ..., GAIN-2[p, c], ...)
//     for p in person
//         scratch.visits[p] = sample discrete@0[p][c in area](row[p, c]
//                                                             / sum[a in area](row[p, a]))
//
// An element that a count of few bools chooses becomes selects, since registers make masks of
// bools, but wait for counts that are stored one by one. As many draws as a register has lanes stay
// as they are: then each lane has a draw.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program weigh_in_rows(ir::Program program, Report& report);

}  // namespace rddlc::passes
