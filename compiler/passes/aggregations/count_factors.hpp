// A product that has the same constant factor wherever a bool is true looks up its power, by the
// count of these bools.
//
//     product[e in row](select(state.invaded[e], 0.4, 1.0))
//                                       =>
//     invaded-powers[sum[e in row](int(state.invaded[e]))]
//
// A factor of 1 rounds nothing, so the powers are the products bit for bit.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program count_factors(ir::Program program, Report& report);

}  // namespace rddlc::passes
