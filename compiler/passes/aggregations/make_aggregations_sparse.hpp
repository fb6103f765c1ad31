// An aggregation to which only some objects contribute runs over these alone.
//
//     sum[d in computer](int(LINK[c, d] && state.up[d]))
//
// becomes, with the links of c being the entries LINK-rows[c] to LINK-rows[c + 1],
//
//     sum[entry in LINK-rows[c] .. LINK-rows[c + 1]](int(state.up[LINK-d[entry]]))
//
// Which objects contribute is what constant tables and comparisons of objects decide
// (sparsity_pattern.hpp). What is fixed for an entry, such as a weight, becomes a table of entries;
// so the dense tables go when remove_unused_buffers finds that nobody reads them. Nested
// aggregations become one. Entries are in the order of the objects, and what is left out would have
// added 0, multiplied by 1 and so on. So values stay the same, except that nested sums and products
// of reals are rounded in another order.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program make_aggregations_sparse(ir::Program program, Report& report);

}  // namespace rddlc::passes
