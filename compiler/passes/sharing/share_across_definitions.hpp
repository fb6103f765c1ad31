// Common subexpressions of several CPFs, or of a CPF and the reward, are computed once.
//
//     next.x = state.x + cos(state.angle)               scratch.cos-angle = cos(state.angle)
//     next.y = state.y + sqrt(cos(state.angle))    =>   next.x = state.x + scratch.cos-angle
//                                                       next.y = state.y + sqrt(scratch.cos-angle)
//
// The value is stored in a table of the variables that it depends on, filled before the first CPF
// that needs it, if that saves work. A fallible expression stays where it is, and so does a long
// computation that no CPF needs in any case. Shorter ones are computed even if no branch that needs
// them is taken, unless all of them wait for a choice of the action (skip_unchosen_sums.hpp).
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program share_across_definitions(ir::Program program, Report& report);

}  // namespace rddlc::passes
