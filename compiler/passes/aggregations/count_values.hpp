// Sums and tests that ask for single values of an int share counts of all its values.
//
//     select by a jump(bits(action.a, 0) != 0,
//                      select(action.a[0], sum[d in die](int(state.v[d] == 0)),
//                             select(action.a[1], sum[d in die](int(state.v[d] == 1)), ...)), 0)
//                                       =>
//     select by a jump(bits(action.a, 0) != 0,
//                      select(action.a[0], bit_and(%, 7),
//                             select(action.a[1], bit_and(shift_right(%, 4), 7), ...)), 0)
//     where % is sum[o in die](v-field[state.v[o]])
//
// An Int has a field of bits for each value (value_counts.hpp). Only where a step may jump over the
// cases: emitted code shares the counts there (ir/shared_in_cases.hpp).
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program count_values(ir::Program program, Report& report);

}  // namespace rddlc::passes
