// An aggregation to which at most one object contributes takes that object.
//
//     exists[d in direction](action.move == d && FREE[x, d])    =>   FREE[x, action.move]
//     sum[t in time](real(TIME[t] == state.now) * load[t])      =>   load of the t with that TIME
//     exists[a in row](ABOVE[a, b] && state.wall[a])            =>   has-ABOVE[b] &&
//                                                                      state.wall[the-ABOVE[b]]
//
// The object is the other side of an equality, or what a constant table says that has at most one
// entry in each row. Whether there is such an object is tested where it is not sure. What may
// fault for another object, or draws, is left alone.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program index_directly(ir::Program program, Report& report);

}  // namespace rddlc::passes
