// Draws of a loop that wait for the choice of an action of which few bools are true are made before
// the loop, for the chosen objects alone.
//
//     for t in tank, several at once
//         next.stock[t] = select(select(action.fill[t], sample bernoulli@0[t](0.9), false), 2, ...)
//                                       =>
//     for t in tank, several at once, chosen by action.fill, others false
//         scratch.fill-draws[t] = select(action.fill[t], sample bernoulli@0[t](0.9), false)
//     for t in tank, several at once
//         next.stock[t] = select(scratch.fill-draws[t], 2, ...)
//
// In packs each environment then draws for its own objects, while a loop over all objects makes
// numbers for every environment at each object that one of them has chosen, and jumps to do so.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program draw_for_chosen(ir::Program program, Report& report);

}  // namespace rddlc::passes
