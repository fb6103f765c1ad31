// Two opposite bounds of a real are one of its absolute value, bit for bit.
//
//     state.x < -2.4 || state.x > 2.4       =>   absolute(state.x) > 2.4
//     state.x >= -2.4 && state.x <= 2.4     =>   absolute(state.x) <= 2.4
//
// The bounds may stand in two invariants, of which the second one becomes true.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program compare_magnitudes(ir::Program program, Report& report);

}  // namespace rddlc::passes
