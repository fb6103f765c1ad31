// An expression over constant tables that depends on no variable outside of it is evaluated now.
//
//     next.cost = cost + sum[r in res](WEIGHT[r])   =>   next.cost = cost + 6.5
//
// With the evaluator that would run it, so the value is the same; unless it faults: then it stays.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program fold_constant_expressions(ir::Program program, Report& report);

}  // namespace rddlc::passes
