// Cases that compare the same counts with constants, and then look up the same int, are one
// look-up.
//
//     select(action.a[0] && sum[d in die](...) == 0 || action.a[1] && sum[d in die](...) == 0,
//            level-by-level[state.level],
//            select(action.a[0] && sum[d in die](...) == 1 || action.a[1] && ... == 1,
//                   level-by-level-2[state.level], select(..., ..., state.level)))
//                                       =>
//     level-cases[level-case[bit_or(select(action.a[0], level-bit[sum[d in die](...)], 0),
//                                   select(action.a[1], level-bit[sum[d in die](...)], 0))],
//                 state.level]
//
// Each count that takes part sets the bit of its value, so that every case is a bit, and the bits
// choose the first case that is met. Processors do not foresee which one that is. Cases that may
// fault or draw stay as they are.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program look_up_cases(ir::Program program, Report& report);

}  // namespace rddlc::passes
