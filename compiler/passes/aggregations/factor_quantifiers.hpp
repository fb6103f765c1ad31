// An exists leaves out the conditions that its variable does not change, and so does a forall:
//
//     exists[d in rover](near[m, d] && !state.harvested[m])
//                                       =>
//     !state.harvested[m] && exists[d in rover](near[m, d])
//
// A rest that computes something can be equal to another expression, so that both are computed once
// (share_across_definitions). Only where nothing can fault. factor_aggregations, which runs where
// aggregations can still become sparse, does this only if some part then depends on fewer loops.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program factor_quantifiers(ir::Program program, Report& report);

}  // namespace rddlc::passes
