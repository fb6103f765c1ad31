// Finds in registers whether a bool holds for one object at least, or for all, where one
// environment computes those of several objects at once (evaluate_together.hpp): without a table.
//
//     for b in wall, several at once                for b in wall, several at once
//         hit[b] = dx * X[b] > y                 =>     hit-exists = hit-exists || dx * X[b] > y
//     violation = bits(hit, 0) != 0                 violation = hit-exists
//
// Nothing else reads the table, and the bools neither fault nor draw. A forall whose bits a mask
// chooses keeps its table.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program quantify_together(ir::Program program, Report& report);

}  // namespace rddlc::passes
