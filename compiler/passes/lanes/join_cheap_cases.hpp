// In loops over several objects at once, cases that cost next to nothing are one branch beside the
// first one that is dear.
//
//     for t in tank, several at once
//         next.stock[t] = select(a[t], 2, select(b[t], 0, select(sample bernoulli@0[t](0.5), ...)))
//                                       =>
//     for t in tank, several at once
//         next.stock[t] = select(a[t] || b[t], select(a[t], 2, 0), select(sample ..., ...))
//
// Several objects, or environments, take all branches that one of them takes, so each case is a
// jump over what is cheaper than the jump.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program join_cheap_cases(ir::Program program, Report& report);

}  // namespace rddlc::passes
