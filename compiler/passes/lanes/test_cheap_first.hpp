// Aggregations of a condition wait for the rest of it, which is cheaper and may decide it already.
// Emitted code names each aggregation before the condition, so `&&` alone does not skip it.
//
//     action.assign[c] && exists[a in die](exists[b in die](...))
//     =>  select(action.assign[c], exists[a in die](exists[b in die](...)), false)
//
// Draws wait for bools of an action of which few are true: packs of environments compute all
// operands of `&&`.
//
//     action.mend[c] && sample bernoulli@0[c](0.9)
//     =>  select(action.mend[c], sample bernoulli@0[c](0.9), false)
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program test_cheap_first(ir::Program program, Report& report);

}  // namespace rddlc::passes
