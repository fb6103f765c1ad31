// Definitions know that they copy the state where an action chooses nothing.
//
//     for o in object
//         next.seen[o] = state.seen[o] || exists[r in rover](action.use[r, o] && WORKS[r])
//                                       =>
//     state.seen unless action.use
//     for o in object
//         next.seen[o] = state.seen[o] || exists[r in rover](action.use[r, o] && WORKS[r])
//
// With false for all bools of the action, what is left of the value is the element of the state.
// Emitted code then skips the loop: for one environment where its action chooses nothing, in packs
// where no action does. Nothing else changes. Loops that do little are left as they are, those of
// which visit_chosen visits the chosen objects alone, and those that may fault where nothing is
// chosen.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program keep_unchosen(ir::Program program, Report& report);

}  // namespace rddlc::passes
