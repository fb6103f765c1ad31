// A draw with a probability that is always 0 or 1 is a condition, and needs no random number.
//
//     Bernoulli(1.0 - prod[e in ROWS[s]](1.0 - real(int(state.fish[S2[e]]) * LINK[e,
//     scratch.water])))
//         =>   !forall[e in ROWS[s]](!(state.fish[S2[e]] && LINK[e, scratch.water] != 0))
//
// Domains write such probabilities as products over neighbours. The text alone does not always show
// them: LINK has to be a table of zeros and ones in this instance.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program decide_draws(ir::Program program, Report& report);

}  // namespace rddlc::passes
