// Sums of reals that only count, in steps of constants, count in ints.
//
//     sum[c in computer](real(state.running[c]) - 0.75 * real(action.reboot[c]))
//                                       =>
//     real(sum[c in computer](int(state.running[c])))
//         - 0.75 * real(sum[c in computer](int(action.reboot[c])))
//
// Ints can be added in any order and all at once. Only where no product inside of a term and no sum
// of the terms is ever rounded, so that the result is the same bit for bit.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program count_bools(ir::Program program, Report& report);

}  // namespace rddlc::passes
