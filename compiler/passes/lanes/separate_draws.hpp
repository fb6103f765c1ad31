// Draws go to a loop of their own, so that what is left of a loop is about bools alone, of which
// a register holds many objects (evaluate_together.hpp).
//
//     for c in cell
//         next.up[c] = select(state.up[c] || !ENTRY[c], state.up[c] && action.go[c],
//                             sample bernoulli@0[c](state.rate[c]))
//                                         =>
//     for c in cell
//         up-draws[c] = !(state.up[c] || !ENTRY[c])
//     for c in cell
//         up-draw[c] = select(up-draws[c], sample bernoulli@0[c](state.rate[c]), false)
//     for c in cell
//         next.up[c] = select(state.up[c] || !ENTRY[c], state.up[c] && action.go[c], up-draw[c])
//
// Still no draw is made that is not needed. Draws with constant probabilities are as good as bools
// (bool_words.hpp), and stay.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program separate_draws(ir::Program program, Report& report);

}  // namespace rddlc::passes
