// The bools that an aggregation counts are computed before it, if they stand at different places of
// tables: in words of bools, whose bits are counted.
//
//     reward = real(sum[c in cell](int(state.up[c] && state.up[NEXT-c[c]])))
//                                         =>
//     for c in cell, as words
//         reward-bools[c] = state.up[c] && element(state.up, reward-bools-places[c])
//     reward = real(count_ones(bits(reward-bools, 0)))
//
// count_bits.hpp does so without a table where all places are the same. An exists or forall stops
// at the first of its terms that decides it, so those stay.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program separate_counts(ir::Program program, Report& report);

}  // namespace rddlc::passes
