// Operators with cheaper equals, bit for bit.
//
//     x / 4.0                    x * 0.25, as powers of two have exact reciprocals
//     power(x, 2.0)              x * x, for cheap x: power() computes just that
//     power(n, 3) of ints        n * n * n
//     0.0 * real(b)              0.0
//     1.25 * real(b) + real(!b)  select(b, 1.25, 1.0)
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program reduce_strength(ir::Program program, Report& report);

}  // namespace rddlc::passes
