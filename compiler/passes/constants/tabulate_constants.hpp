// An expression of tables and loop variables only is computed now, into a table of those variables.
//
//     x = sum[s in segment]((Y2[s] - Y1[s]) / (X2[s] - X1[s]) * real(state.on[s]))
//                                       =>
//     x-table[segment]: real = 0.25, 1.5, ...
//     x = sum[s in segment](x-table[s] * real(state.on[s]))
//
// The pass does so if that saves something and the table is not much larger than those that it is
// made from. A table of equal elements is one constant. An expression that faults for any
// combination of the variables stays. A table is named after the fluent in whose CPF the expression
// occurs first.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program tabulate_constants(ir::Program program, Report& report);

}  // namespace rddlc::passes
