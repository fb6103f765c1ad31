// Sums that add zeros unless an action chooses something wait for a test of its tables.
//
//     sum[g in good](real(action.sell[g]) * PRICE[g] * state.demand[g])
//                                       =>
//     select(bits(action.sell, 0) != 0,
//            sum[g in good](real(action.sell[g]) * PRICE[g] * state.demand[g]), 0.0)
//
// A sum of reals begins with 0.0, so that zeros of either sign leave it 0.0. Only expensive sums of
// the reward are tested, those that neither draw nor fault. Actions that choose nothing at all are
// rare, so a test of all their tables would hardly ever skip anything.
//
// So do cases, of the reward or of a CPF without parameters, whose conditions are expensive and
// which are a constant or a value of the state where one table of the action chooses nothing:
//
//     select(action.assign[1] && sum[d in die](...) == 0, 1, select(..., state.level))
//                                       =>
//     select(bits(action.assign, 0) != 0, select(..., state.level), state.level)
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program skip_unchosen_sums(ir::Program program, Report& report);

}  // namespace rddlc::passes
