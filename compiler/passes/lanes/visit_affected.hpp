// Loops over bools that draw know which objects a table of few true bools can make true.
//
//     for x in cell, as words
//         next.at[x] = select(element(state.at, EAST[x]), sample bernoulli@0[x](P[x]), false)
//                                       =>
//     for x in cell, as words, affected by state.at
//         next.at[x] = select(element(state.at, EAST[x]), sample bernoulli@0[x](P[x]), false)
//
// Where all bools of the other table are false, so are those of the loop. One environment then
// computes the bools of those objects alone that read a true one, unless many are true; packs of
// environments compute all. Nothing else changes. Whether few are true is taken from the initial
// state.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program visit_affected(ir::Program program, Report& report);

}  // namespace rddlc::passes
