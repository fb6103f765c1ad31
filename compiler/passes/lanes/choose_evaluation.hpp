// Writes into the program how emitted code evaluates what it may evaluate in several ways. The
// values are the same; the last pass, since it goes by the final expressions.
//
//     select(state.on[x], 2.0 * state.heat[x], 0.0)
//                              =>  select both(state.on[x], 2.0 * state.heat[x], 0.0)
//     sample bernoulli@0[x](RATE[x])
//                              =>  sample valid bernoulli@0[x](RATE[x])
//     real(round(state.heat[x]))
//                              =>  rounded real(round(state.heat[x]))
//     sum[x in zone](select(state.on[x], state.heat[x], 0.0))
//                              =>  sum over true[x in zone](select ...)
//
// conditions test several objects at once
//
//     forall[x in zone](state.heat[x] >= 0.0)
//                              =>  forall several at once[x in zone](adjacent state.heat[x] >= 0.0)
//
// and in loops over several objects at once
//
//     state.on[x]              =>  adjacent state.on[x]
//     state.open[y, x]         =>  in row state.open[y, x]
//     HEAT[KIND[x], count]     =>  rows HEAT[adjacent KIND[x], count]
//     state.on[NEXT[x]]        =>  own state.on[adjacent NEXT[x]]
//     sample bernoulli@0[x](RATE[x])
//                              =>  sample valid bernoulli@0[x](chances RATE[x])
//     sample bernoulli@0[x](select(state.on[x] > 2, RATE[x], NOISE[x]))
//                              =>  sample valid bernoulli@0[x](select both(
//                                      adjacent state.on[x] > 2, chances RATE[x], chances
//                                      NOISE[x]))
//
// and in those over words of bools, which draw for the objects that need it
//
//     state.on[x] && sample bernoulli@0[x](0.5)
//                              =>  select(adjacent state.on[x], sample bernoulli@0[x](0.5), false)
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program choose_evaluation(ir::Program program, Report& report);

}  // namespace rddlc::passes
