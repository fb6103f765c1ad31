// Marks the loops whose iterations may be evaluated several at once, in vector registers, where
// there is but one environment (rddl/object_lanes/objects.hpp). Nothing else changes.
//
//     for x in computer                               for x in computer, several at once
//         next.up[x] = sample bernoulli@0[x](P[x])  =>    next.up[x] = sample bernoulli@0[x](P[x])
//
// Loops right inside each other become one over all combinations. What they read and write are the
// elements of their objects, or what is the same for all, without aggregations; they draw, or
// compute bools, or reals that are not cheap. Fewer than 8 iterations do not fill the registers,
// which pays only for reals and ints that take long, such as elementary functions and draws from
// weights, and for four reals that would jump.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program evaluate_together(ir::Program program, Report& report);

}  // namespace rddlc::passes
