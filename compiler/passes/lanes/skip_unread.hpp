// Tables that nothing but skipped definitions reads are skipped with them.
//
//     for c in city
//         scratch.cars[c] = sum[x in car](int(state.at[x, c]))
//     next.fuel = state.fuel - 1
//     state.at unless action.drive
//     for x in car
//         for c in city
//             next.at[x, c] = select(action.drive[x, c], scratch.cars[c] < 3, state.at[x, c])
//                                       =>
//     next.fuel = state.fuel - 1
//     unread unless action.drive
//     for c in city
//         scratch.cars[c] = sum[x in car](int(state.at[x, c]))
//     state.at unless action.drive
//     ...
//
// Where the action chooses nothing, nothing reads the number of cars, so that emitted code leaves
// it out by the same jump. That is rare, and so not done, where the test is of all tables of the
// action. What may fault stays, as do tables that functions of tables overwrite.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program skip_unread(ir::Program program, Report& report);

}  // namespace rddlc::passes
