// An exists over objects whose places are constants is false without a look at them where a table
// of places says so.
//
//     for b in wall, several at once                for b in wall, several at once, near
//         hit-exists = hit-exists || ...      =>            clearances[x, y] of dx, dy
//                                                       hit-exists = hit-exists || ...
//
// The places, x and y, are compared with constants of the objects; the other numbers are moves. The
// grid of the table has cells as wide as all these constants divided by the number of cells. For a
// place in a cell, and moves nearer to 0 than the cell's clearance, the condition is proved to be
// false for all objects (passes/analyses/refutation.hpp), so no value changes.
//
// Robots plan with such maps: J.-C. Latombe, Robot Motion Planning, 1991.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program tabulate_clearances(ir::Program program, Report& report);

}  // namespace rddlc::passes
