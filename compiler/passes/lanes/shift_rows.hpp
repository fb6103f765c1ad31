// Marks the loops of a step for moderate values that move the elements of the state one place
// towards the front of their rows (ir/shifted_row.hpp). Nothing else changes.
//
//     for u in link                                  for u in link
//         for t in time                          =>      for t in time, shifts
//             next.flow[u, t] = 0.0 + (...)                  next.flow[u, t] = 0.0 + (...)
//
// Emitted code moves whole tables, in packs of programs that cannot fault without moving them
// (rddl/values/sliding_tables.hpp), and adds terms to the elements that have some. What the state
// was is lost then, so nothing reads it later in the step. The rows have as many reals as a
// register, or more, and several for each term.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program shift_rows(ir::Program program, Report& report);

}  // namespace rddlc::passes
