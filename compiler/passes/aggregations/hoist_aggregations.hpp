// An expression that does not depend on all of the loops around it, but on an inner one, becomes a
// table of the variables that it depends on. So a nested aggregation costs the sum and not the
// product of its sizes.
//
//     for p in provider
//         next.sold[p] = sum[i in item](select(by[p, i], sum[c in consumer](int(buys[c, i])), 0))
//                                       =>
//     for i in item
//         scratch.sold-by-item[i] = sum[c in consumer](int(buys[c, i]))
//     for p in provider
//         next.sold[p] = sum[i in item](select(by[p, i], scratch.sold-by-item[i], 0))
//
// A constant table may choose the few objects for which an aggregation is needed:
//
//     for t in tool
//         next.broken[t] = ... sum[x in pos](real(state.at[OWNER[t], x]) * RISK[x]) ...
//                                       =>
//     for r in rover
//         scratch.broken-by-rover[r] = sum[x in pos](real(state.at[r, x]) * RISK[x])
//     for t in tool
//         next.broken[t] = ... scratch.broken-by-rover[OWNER[t]] ...
//
// So may it choose for an exists or forall that another aggregation repeats. Of an exists or forall
// the conditions that its variable does not change stay where they are:
//
//     for y in row
//         free[y] = forall[j in shape](!(exists[x in column](IS-THERE[y, j] && at[x, ROW[y, j]])))
//                                       =>
//     for r in row
//         scratch.free-by-row[r] = exists[x in column](at[x, r])
//     for y in row
//         free[y] = forall[j in shape](!(IS-THERE[y, j] && scratch.free-by-row[ROW[y, j]]))
//
// Bools of the objects of a loop are the last dimension of their table, so that registers take rows
// of them (evaluate_together).
//
// The table is filled before the statement that needs it; later statements of the step, and the
// reward, also use it. A fallible expression stays where it is. Conditions have no tables, so they
// are left alone. share_subexpressions names expressions that an outer loop fixes.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program hoist_aggregations(ir::Program program, Report& report);

}  // namespace rddlc::passes
