// An interm-fluent that is one of a few ints, and only compared with constants, gives way to the
// conditions that choose the int.
//
//     for c in city
//         scratch.status[c] = select(state.cars[c] > 3, 2, select(state.rain, 1, 0))
//     ... scratch.status[c] == 2 ...           =>   ... state.cars[c] > 3 ...
//     ... scratch.status[c] == 1 ...           =>   ... !(state.cars[c] > 3) && state.rain ...
//
// So enumerations that domains introduce for readers take neither tables nor registers of ints.
// Conditions that are aggregations, that draw or that may fault stay where they are.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program compare_cases(ir::Program program, Report& report);

}  // namespace rddlc::passes
