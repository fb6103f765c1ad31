// Tables of constants decide which objects of a loop reach an expression: what is the same for all
// of those is known there, and places that none of those reads may be any others.
//
//     for c in cell
//         next.up[c] = select(ENTRY[c], IN[c] && element(state.up, places[c]),
//                             OUT[c] && element(state.up, places-2[c]))
//                                         =>
//     for c in cell
//         next.up[c] = select(ENTRY[c], element(state.up, places[c]),
//                             OUT[c] && element(state.up, places[c]))
//
// IN is true for all objects for which ENTRY is, and the tables of places agree for all objects
// that read both. So several objects at once need fewer constants and permutations, and the places
// that no object reads make longer lines of consecutive ones, which packs load whole.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program narrow_objects(ir::Program program, Report& report);

}  // namespace rddlc::passes
