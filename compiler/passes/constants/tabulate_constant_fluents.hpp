// An interm- or derived-fluent that depends on nothing but non-fluents becomes a constant table.
//
//     for a in row                                      above[row, row]: bool = false, true, ...
//         for b in row
//             scratch.above[a, b] = Y[a] == Y[b] + 1
//     ... scratch.above[c, d] ...                  =>   ... above[c, d] ...
//
// A fluent that may fault stays. remove_unused_buffers removes the unread fluent.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program tabulate_constant_fluents(ir::Program program, Report& report);

}  // namespace rddlc::passes
