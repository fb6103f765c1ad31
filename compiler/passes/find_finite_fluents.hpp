// Finds out which fluents are never inf or nan, now that the tables of the instance are known.
//
//     PARTS[r]: real = {7.0 1.0 9.0}
//     scratch.part[r] = state.water[r] / PARTS[r]      is finite: no element of PARTS is 0
//
// Changes nothing but Buffer::finite, from which other passes gain: 0 * part[r] is 0. As
// everywhere, sums and products are taken not to overflow, and actions to be finite.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program find_finite_fluents(ir::Program program, Report& report);

}  // namespace rddlc::passes
