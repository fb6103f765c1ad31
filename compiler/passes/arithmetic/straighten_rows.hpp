// Rows of tables that passes have made, and that are lines except for rounding, become lines: then
// the emitted code computes their elements if that is faster (rddl/object_lanes/rows.hpp). Only
// with --fast-math, since elements change by some units in the last place.
//
//     0.525, 0.5725, 0.6199999999999999, 0.6675     0.525, 0.5725, 0.62, 0.6675
//
// A line rises from the first element by the difference to the second one. Where it would pass the
// last element, that is repeated.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program straighten_rows(ir::Program program, Report& report);

}  // namespace rddlc::passes
