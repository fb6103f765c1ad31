// A constant table whose entries are all equal becomes that value where it is read.
//
//     CAPACITY[res]: real = 10.0                 CAPACITY[res]: real = 10.0
//     next.level[r] = min(level[r], CAPACITY[r])  =>  next.level[r] = min(level[r], 10.0)
//
// remove_unused_buffers removes the unread table. An index that draws
// or may fault keeps the table.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program fold_uniform_tables(ir::Program program, Report& report);

}  // namespace rddlc::passes
