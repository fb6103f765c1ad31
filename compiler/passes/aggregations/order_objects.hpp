// A quantifier visits objects that may change places in one order.
//
//     forall[p in person](forall[q in person](p == q || state.x[p] != state.x[q]))
//                                       =>
//     forall[p in person](forall[q in p + 1 .. person](state.x[p] != state.x[q]))
//
// So n of them have n! times fewer combinations. Terms of equal objects must change nothing, and
// none may draw or fault. Which of several equal values are compared makes no difference:
// a == b && a == c is b == a && b == c.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program order_objects(ir::Program program, Report& report);

}  // namespace rddlc::passes
