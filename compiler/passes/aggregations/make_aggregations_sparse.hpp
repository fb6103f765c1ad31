// An aggregation to which only some objects contribute runs over these alone.
//
//     sum[d in computer](int(LINK[c, d] && state.up[d]))
//
// becomes, with the links of c being the entries LINK-rows[c] to LINK-rows[c + 1],
//
//     sum[entry in LINK-rows[c] .. LINK-rows[c + 1]](int(state.up[LINK-d[entry]]))
//
// Constant tables and comparisons of objects decide which objects contribute
// (sparsity_pattern.hpp). Values that are fixed for an entry, such as a weight, become a table of
// entries; then remove_unused_buffers removes the unread dense tables. Nested aggregations become
// one. Entries are in the order of the objects, and the omitted ones would have added 0, multiplied
// by 1 and so on. So values stay the same, except that nested sums and products of reals are
// rounded in another order.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program make_aggregations_sparse(ir::Program program, Report& report);

}  // namespace rddlc::passes
