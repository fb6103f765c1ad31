// A row of bools that depends on the values of a few ints becomes one int. Each value sets its bit.
//
//     before:  for n in number
//                  next.seen[n] = select(action.stop, false, state.seen[n] ||
//                      exists[d in die](action.roll[d] && scratch.face[d] == n))
//     after:   spread next.seen = select(action.stop, 0, bit_or(bits(state.seen, 0), bit_or(
//                  select(action.roll[0], seen-bit[scratch.face[0]], 0),
//                  select(action.roll[1], seen-bit[scratch.face[1]], 0))))
//
// So each die is read once, and not for each number, and a condition that is the same for all
// numbers is tested once. Rows have at most 64 elements. An exists in the reward gets a row:
//
//     before:  sum[a in area](select(exists[t in thief](scratch.robs[t] == a), -5.0, 2.0))
//     after:   spread scratch.reward-row = bit_or(reward-bit[scratch.robs[0]], ...)
//              sum[a in area](select(scratch.reward-row[a], -5.0, 2.0))
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program set_bits(ir::Program program, Report& report);

}  // namespace rddlc::passes
