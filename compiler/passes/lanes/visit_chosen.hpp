// Loops that draw bools know which objects an action leaves as they are.
//
//     for c in course, several at once
//         next.passed[c] = select(action.take[c], sample bernoulli@0[c](P[n]), state.passed[c])
//                                       =>
//     for c in course, several at once, chosen by action.take, others state.passed
//         next.passed[c] = select(action.take[c], sample bernoulli@0[c](P[n]), state.passed[c])
//
// One environment then computes the bools of the chosen objects alone, unless many are chosen, and so
// does each environment of a pack. Nothing else changes. Whether few are chosen is taken from
// max-nondef-actions and the preconditions (Buffer::most_true).
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program visit_chosen(ir::Program program, Report& report);

}  // namespace rddlc::passes
