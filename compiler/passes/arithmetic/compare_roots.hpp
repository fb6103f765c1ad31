// A square root that is only compared with a constant is not taken, bit for bit: roots grow with
// their operands, so a comparison changes at one operand, the nearest to the constant's square.
//
//     sqrt(x * x + y * y) <= 0.04       =>   x * x + y * y <= 0.0016
//     sqrt(x * x + y * y) < AREA[m]     =>   x * x + y * y < AREA-squares[m]
//
// The operand has to be a sum of squares or the like: the root of a negative number is nan.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program compare_roots(ir::Program program, Report& report);

}  // namespace rddlc::passes
