// Common subexpressions are computed once, and loop-invariant ones before the loop.
//
//     for c in computer                              let %0 = exists[d in computer](state.up[d])
//         next.up[c] = exists[d in computer]    =>   for c in computer
//             (state.up[d]) && state.on[c]               next.up[c] = %0 && state.on[c]
//
//     next.x = sqrt(a * b) + 1.0 / sqrt(a * b)  =>   let %0 = sqrt(a * b)
//                                                    next.x = %0 + 1.0 / %0
//
// A Let stands before the outermost statement of the block in which all its loop indices are bound,
// and only for expressions that the statement evaluates in any case, or that a lazy branch of a
// Select in a loop may need again and again: if they cost little beside the loop, and neither fault
// nor draw. Trivial expressions are repeated instead.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program share_subexpressions(ir::Program program, Report& report);

}  // namespace rddlc::passes
