// An addition computes only the terms that constants let count.
//
//     total + real(IS_OUTER[s]) * (normal(4.0, 1.0) - state.temp[s])
//                                       =>
//     total + select(IS_OUTER[s], normal(4.0, 1.0) - state.temp[s], 0.0)
//
// The other factors have to be finite, expensive, and must not fault; the other operand must not be
// -0.0, since the product may be: then it matters which zero is added.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program skip_added_zeros(ir::Program program, Report& report);

}  // namespace rddlc::passes
