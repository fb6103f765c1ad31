// A condition that all cases of one int share is tested once.
//
//     select(state.on && state.level == 0, 1, select(state.on && state.level == 1, 4, ..., 0))
//                                       =>
//     select(state.on, select(state.level == 0, 1, select(state.level == 1, 4, ..., 0)), 0)
//
// The other conditions depend on the int alone, so that tabulate_counts makes a table of them, and
// merge_draws one draw of several. If there is a case for each value in the range of the int, the
// last one needs no test. Only where the conditions neither fault nor draw, and where what
// no case meets is cheap, since it is written twice.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program factor_cases(ir::Program program, Report& report);

}  // namespace rddlc::passes
