// Sums in which only the true elements of a row of bools count.
//
//     sum[i in item](int(state.p[c, i]))
//     sum[i in item](select(state.p[c, i], x, 0.0))
#pragma once

#include "ir/ir.hpp"

namespace rddlc::ir {

// The element at the sum's variable: the last dimension of its table is the row, and the other
// indices are loop indices and constants. Null if the row is short or the reduction is of another
// form. The zero is +0.0, so that a sum, which is never -0.0, is the same without it.
const Load* row_of_bools(const Program& program, const Reduce& reduce);
// Whether a node is such an element at that variable.
bool is_in_row_of_bools(const Program& program, NodeId id, VariableId variable);

}  // namespace rddlc::ir
