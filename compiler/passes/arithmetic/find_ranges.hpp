// Finds within which ranges the reals lie that a step computes, now that the tables of the instance
// are known.
//
//     PARTS[r]: real = {7.0 1.0 9.0}
//     scratch.part[r] = state.water[r] / PARTS[r]      is finite if the water is: no part is 0
//
// Changes nothing but Buffer::range, from which other passes gain: 0 * part[r] is 0.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program find_ranges(ir::Program program, Report& report);

}  // namespace rddlc::passes
