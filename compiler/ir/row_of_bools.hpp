// Sums in which only the true elements of a row of bools count, or of a table with two dimensions.
//
//     sum[i in item](int(state.p[c, i]))
//     sum[i in item](select(state.p[c, i], x, 0.0))
//     sum[x in xpos](sum[y in ypos](select(state.at[r, x, y], GAIN[x, y], 0.0)))
#pragma once

#include "ir/ir.hpp"

namespace rddlc::ir {

// The element at the sum's variable: the last dimension of its table is the row, and the other
// indices are loop indices and constants. Null if the row is short or the reduction is of another
// form. The zero is +0.0, so that a sum, which is never -0.0, is the same without it.
const Load* row_of_bools(const Program& program, const Reduce& reduce);
// The element at the variables of a sum and of the sum that is its body: they are the last two
// dimensions of its table. Null for sums of another form.
const Load* table_of_bools(const Program& program, const Reduce& reduce);
// The element of a table of real constants that such a sum adds where a bool is true: the same
// variables are the last dimensions of its table. Null if the terms are of another form, or if the
// bools do not say where something is: one of each row or table is true when an episode begins.
const Load* constants_over_true(const Program& program, const Reduce& reduce);
// Whether a node is an element at that variable, its last index.
bool is_in_row_of_bools(const Program& program, NodeId id, VariableId variable);

}  // namespace rddlc::ir
