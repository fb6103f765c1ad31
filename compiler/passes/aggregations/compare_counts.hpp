// An exists or forall next to a sum of the same bools compares the sum.
//
//     select(exists[o in obj](state.p[o]), f(sum[o in obj](int(state.p[o]))), 0.0)
//                                       =>
//     select(sum[o in obj](int(state.p[o])) > 0, f(sum[o in obj](int(state.p[o]))), 0.0)
//
// So the objects are visited once, or everything that depends on the number becomes one table.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program compare_counts(ir::Program program, Report& report);

}  // namespace rddlc::passes
