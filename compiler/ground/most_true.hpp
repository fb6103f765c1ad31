// How many bools of each table of the action may be true, as far as max-nondef-actions and the
// preconditions say so (Buffer::most_true).
//
//     precondition sum[s in spring](int(action.poison[s])) + ... <= 4       at most 4 of poison
//     precondition forall[r in ranger](sum[a in area](int(action.defend[a, r])) == 1)
//                                                                   at most one for each ranger
#pragma once

#include "ir/builder.hpp"
#include "ir/ir.hpp"

namespace rddlc::grounding {

// The builder is of this program.
void find_most_true(const ir::Builder& builder, ir::Program& program);

}  // namespace rddlc::grounding
