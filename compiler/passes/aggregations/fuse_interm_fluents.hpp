// The expression of an interm- or derived-fluent replaces its reads, unless that repeats work.
//
//     for s in segment
//         scratch.inside[s] = LEFT[s] <= state.x
//     next.x = sum[s in segment](                 =>   next.x = sum[s in segment](
//         real(scratch.inside[s]))                         real(LEFT[s] <= state.x))
//
// So cheap ones may be read several times, others once for each element. A single value that is not
// cheap keeps its name. One that may fault stays, because its reader might not evaluate it.
// remove_unused_buffers removes the unread buffer.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program fuse_interm_fluents(ir::Program program, Report& report);

}  // namespace rddlc::passes
