// Factors that an inner variable does not change are taken out of its aggregation, so that the rest
// depends on fewer variables and can become a table (hoist_aggregations).
//
//     for p in provider
//         next.sold[p] = sum[c in consumer](sum[i in item](int(buys[c, i] && by[p, i])))
//                                       =>
//         next.sold[p] = sum[i in item](select(by[p, i], sum[c in consumer](int(buys[c, i])), 0))
//
// For sums of ints, exists and forall, where the order of terms does not matter; and only where
// nothing can fault.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program factor_aggregations(ir::Program program, Report& report);

}  // namespace rddlc::passes
