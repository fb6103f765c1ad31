// Removes unread buffers: constant tables, and interm- and derived-fluents with the statements
// that fill them.
//
//     scratch.seen[c] = running[c] && noisy[c]
//     next.running[c] = running[c]                =>   next.running[c] = running[c]
//
// An interm-fluent that may fault stays: the fault would end the episode. One that draws may go,
// because a draw depends on its place only, never on other draws. Fluent::buffer of a removed
// fluent is empty, and sites keep their numbers.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program remove_unused_buffers(ir::Program program, Report& report);

}  // namespace rddlc::passes
