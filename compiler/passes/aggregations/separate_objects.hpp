// A quantifier over objects that must be different asks for each of them alone, where what it wants
// of them tells them apart.
//
//     exists[d in die](exists[e in die](d != e && state.v[d] == 1 && state.v[e] == 2))
//                                       =>
//     exists[d in die](state.v[d] == 1) && exists[e in die](state.v[e] == 2)
//
// One object has not both values, so d != e says nothing. An exists of several cases is one for
// each of them. A forall is the same of what is not true. Only where nothing draws or faults.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program separate_objects(ir::Program program, Report& report);

}  // namespace rddlc::passes
