// An expression of a drawn bool and of one element of a constant table becomes a table of both.
//
//     floor(demand-by-epoch[state.epoch, w] + real(sample bernoulli@0[w](0.5)))
//                                       =>
//     demand-by-draw[state.epoch, w, int(sample bernoulli@0[w](0.5))]
//
// An element that is hardly ever computed in another way (Evaluated::MostlyFirst) counts as well:
// the other way computes the expression. So one look-up takes the place of arithmetic that would
// wait for the random number.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program tabulate_draws(ir::Program program, Report& report);

}  // namespace rddlc::passes
