// A small table that is filled with sums over rows of a sparse table is filled element by element:
// without loops, and without looking up which objects the entries stand for.
//
//     for c in computer: part[c] = sum[entry in LINK-rows[c] .. LINK-rows[c + 1]](x[LINK-d[entry]])
//
// becomes
//
//     part[0] = x[2] + x[5] + x[6]
//     part[1] = x[0]
//     part[2] = 0.0
//
// A sum of reals whose terms may all be -0.0 begins with 0.0. What draws or may fault stays in its
// loop.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program unroll_rows(ir::Program program, Report& report);

}  // namespace rddlc::passes
