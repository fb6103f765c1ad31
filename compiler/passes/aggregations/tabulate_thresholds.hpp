// A Discrete whose weights the instance and a few small ints decide becomes a search among
// thresholds, the sums of the weights so far:
//
//     sample discrete@0[d](FACE-PROB[d, state.mood, 0], FACE-PROB[d, state.mood, 1], ...)
//                                       =>
//     sample interval@0[d](face-thresholds[d, state.mood])
//
// A step then neither checks nor adds weights, and the draw cannot fault. So this is done only
// where the weights are right whatever the ints are. Poisson and Binomial draws of small means are
// searches as well, since one uniform number decides them; the thresholds are the least numbers
// with which a step draws each count. Draws of two branches that have the same
// random numbers become one, from a table of the rows of both:
//
//     select(state.wet, sample interval@0[c](thresholds), sample interval@1[c](thresholds-2))
//                                       =>
//     sample interval@0[c](thresholds-3[select(state.wet, 0, 1)])
//
// The sums are those of reals of 32 bits in programs that compute with them.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program tabulate_thresholds(ir::Program program, Report& report);

}  // namespace rddlc::passes
