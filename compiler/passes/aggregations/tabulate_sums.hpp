// A sum in the reward looks up its terms, which bools choose from two constants each, by the bits
// of these bools.
//
//     spread scratch.row = bit_or(room-bit[scratch.robs[0]], room-bit[scratch.robs[1]])
//     sum[a in room](select(scratch.row[a] && !state.shut[a], -5.0, GAIN[a]))
//                                       =>
//     reward-sums[bit_and(bit_or(room-bit[scratch.robs[0]], room-bit[scratch.robs[1]]),
//                         bit_xor(bits(state.shut, 0), 255))]
//
// One row at least has to be spread from an int (set_bits.hpp), or the bools alone are a short row
// of the state, whose bits one load makes: to make the bits of other bools takes longer than to add
// the terms. Bools that are no row get a table:
//
//     for a in room
//         scratch.reward-bools[a] = exists[g in guard](action.watch[a, g])
//
// The table has the sums of the first 8 terms, added in their order. Each further term is
// looked up and added by itself: + reward-terms[bit_and(shift_right(..., 8), 1)].
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program tabulate_sums(ir::Program program, Report& report);

}  // namespace rddlc::passes
