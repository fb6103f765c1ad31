// A draw from weights that are one expression of different objects becomes a draw over the objects:
//
//     sample discrete@0[p](f(p, 0) / sum[a in area](f(p, a)),
//                          f(p, 1) / sum[a in area](f(p, a)), ...)
//                                       =>
//     for choice in area
//         for p in poacher
//             parts[choice, p] = f(p, choice)
//     sample discrete@0[p][choice in area](parts[choice, p] / sum[a in area](parts[a, p]))
//
// So the passes that know loops see one, and what the weights have in common with a sum that they
// are divided by is computed once for each object.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program draw_over_objects(ir::Program program, Report& report);

}  // namespace rddlc::passes
