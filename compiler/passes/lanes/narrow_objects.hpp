// Constants decide which objects of a loop reach an expression. A bool that only constants decide,
// and that is the same for all of these objects, becomes true or false there. Tables of places may
// hold any values for the objects that do not read them.
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
