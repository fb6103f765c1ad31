// Draws of two branches that have the same random numbers, since only one is evaluated, become one.
//
//     select(state.up[c], sample bernoulli@0[c](P[c]), sample bernoulli@1[c](0.1))
//                                       =>
//     sample bernoulli@0[c](select(state.up[c], P[c], 0.1))
//
// Along a chain of else-ifs, draws become one draw under the condition that one of them is made:
//
//     select(a, sample bernoulli@0[c](0.2), select(b, true, select(d, sample bernoulli@1[c](P[c]),
//                                                                  state.up[c])))
//                                       =>
//     select(a || !b && d, sample bernoulli@0[c](select(a, 0.2, P[c])),
//            select(b, true, state.up[c]))
//
// Packs, of which some lanes take each branch, then draw once. If the parameters of one draw may be
// wrong, its place stays, so that the fault is reported for the right one. A draw that is also used
// elsewhere, such as in the condition, stays as it is: a site draws for one node.
//
// If the condition reads the same objects as the probability, a constant branch is merged as well:
//
//     select(up-neighbours == 0, false, sample bernoulli@0[c](f(up-neighbours)))
//                                       =>
//     sample bernoulli@0[c](select(up-neighbours == 0, 0.0, f(up-neighbours)))
//
// A draw with a probability of 0 or 1 is that bool.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program merge_draws(ir::Program program, Report& report);

}  // namespace rddlc::passes
