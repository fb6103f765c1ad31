// Rewrites that are right for real numbers, but not always for floating ones: only with
// --fast-math. docs/fast-math.md says what may change.
//
//     x / 3.0                                x * 0.3333333333333333
//     x / E[o]                               x * (1.0 / E[o])
//     x * 2.5 * 4.0, x * 3.0 / 2.0           x * 10.0, x * 1.5
//     power(x, 3.0), power(x, 0.5)           x * x * x (for cheap x), sqrt(x)
//     0.0 * x                                0.0, unless x draws or may fault
//     select(a == 0.0, a, a * b)             a * b, unless b draws or may fault
//
// The passes behind it may take all reals that are computed to be finite.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program fast_math(ir::Program program, Report& report);

}  // namespace rddlc::passes
