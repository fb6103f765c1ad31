// An addition computes an expensive term only where constants let it count.
//
//     total + real(IS_OUTER[s]) * (normal(4.0, 1.0) - state.temp[s])
//                                       =>
//     total + select(IS_OUTER[s], normal(4.0, 1.0) - state.temp[s], 0.0)
//
// It chooses a term that is computed once for a loop, in place of multiplying in each iteration:
//
//     for t in time
//         next.flow[t] = 0.0 + real(TIME[t] == state.delay) * (state.speed * state.width)
//                                       =>
//     for t in time
//         next.flow[t] = 0.0 + select(TIME[t] == state.delay, state.speed * state.width, 0.0)
//
// The other factors have to be finite and must not fault; the other operand must not be -0.0, since
// the product may be: then it matters which zero is added.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program skip_added_zeros(ir::Program program, Report& report);

}  // namespace rddlc::passes
