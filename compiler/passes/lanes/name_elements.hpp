// A loop over many bools evaluates all of its branches, so elements that several of them choose by
// their places are chosen once.
//
//     for c in cell, as words
//         next.up[c] = select(state.on[c], element(state.up, places[c]),
//                             OPEN[c] && element(state.up, places[c]))
//                                         =>
//     for c in cell, as words
//         let %0 = element(state.up, places[c])
//         next.up[c] = select(state.on[c], %0, OPEN[c] && %0)
//
// share_subexpressions.hpp leaves what only branches need, and runs before it is known which loops
// are over words.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program name_elements(ir::Program program, Report& report);

}  // namespace rddlc::passes
