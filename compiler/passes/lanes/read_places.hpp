// Bools that constants choose for each object of a loop are read by their places, so that the loop
// can be evaluated for several objects at once (evaluate_together.hpp).
//
//     for x in x_pos
//         for y in y_pos
//             next.at[x, y] = EAST-is-there[x] && state.at[EAST-object[x], y]
//                                         =>
//             next.at[x, y] = at-table[x, y] && element(state.at, at-places[x, y])
//
// Other values that constants decide in such a loop also become tables of its objects; an exists or
// forall over the few entries of a row, or over a type of few objects, becomes its terms:
//
//     next.up[c] = exists[entry in LINK-rows[c] .. LINK-rows[c + 1]](state.up[LINK-d[entry]])
//                                         =>
//     next.up[c] = up-table[c] && element(state.up, up-places[c])
//                  || up-table-2[c] && element(state.up, up-places-2[c])
//
// All of a loop is rewritten or nothing, so loops that would still not run over several objects
// stay as they are.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program read_places(ir::Program program, Report& report);

}  // namespace rddlc::passes
