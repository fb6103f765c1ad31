// The sine and the cosine of an angle are computed in one loop.
//
//     for o in obj                                  for o in obj
//         next.x[o] = r * cos(state.a[o])               let sine = sin(state.a[o])
//     for o in obj                          =>          let cosine = cos(state.a[o])
//         next.y[o] = r * sin(state.a[o])               scratch.sin-a[o] = sine
//                                                       scratch.cos-a[o] = cosine
//                                                   for o in obj
//                                                       next.x[o] = r * scratch.cos-a[o]
//                                                   ...
//
// C++ compilers see that both reduce the same angle and evaluate the same polynomials, since
// nothing is stored in between. Only those count that every step needs, in two CPFs, of angles that
// are known before the step.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program pair_angles(ir::Program program, Report& report);

}  // namespace rddlc::passes
