// Rows of bools of which an exists asks whether all have a true element at the same place.
//
//     exists[l in place](action.drive[t, l] && action.drive[u, l] && state.open[t])
//
// One environment joins the bytes of such rows, many at once (rddl::is_any_in_all).
#pragma once

#include "ir/ir.hpp"

#include <optional>
#include <vector>

namespace rddlc::ir {

struct CommonRows {
    std::vector<const Load*> rows;  // their elements at the variable of the exists
    std::vector<NodeId> others;     // conditions beside them, which do not depend on it
};

// Nothing if the reduction is of another form, or if its rows are short or not bools of the state
// or the action: the bytes of other tables have just been stored, one by one, so that one
// environment would wait for them.
std::optional<CommonRows> common_rows(const Program& program, const Reduce& reduce);

}  // namespace rddlc::ir
