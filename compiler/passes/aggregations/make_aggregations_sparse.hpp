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
// entries, and those that an entry and one int of a small range decide become a row of each entry:
// RATE[c, d, state.mode] is RATE-entries[entry, state.mode]. Then remove_unused_buffers removes the
// unread dense tables. Nested aggregations become one. Those of reals stay nested, since partial
// sums are rounded: an outer one runs over the objects that have entries, an inner one over the
// entries of such an object.
//
//     sum[x in cell](sum[y in cell](RATE[x, y] * real(state.on[y])))
//                                       =>
//     sum[entry-2 in cell](sum[entry in RATE-rows[entry-2] .. RATE-rows[entry-2 + 1]](
//         RATE-entries[entry] * real(state.on[RATE-y[entry]])))
//
// Where a row has one entry at most, and few have none, there is no loop over entries:
//
//     prod[d in computer](select(LINK[c, d] && state.up[d], 0.5, 1.0))
//                                       =>
//     select(LINK-is-there[c], select(state.up[LINK-d[c]], 0.5, 1.0), 1.0)
//
// Where constants make a term of each row false, a forall is false; an exists is true if they make
// one true:
//
//     forall[d in computer](LINK[c, d] && state.up[d])   =>   false
//
// Entries are in the order of the objects, and the omitted ones would have added 0, multiplied by 1
// and so on. A zero times a factor that may be inf would have added nan; if the factor is the same
// for all objects, one such term stands for all omitted ones:
//
//     sum[y in cell](RATE[x, y] * state.s)   =>   sum[entry in ...](RATE-entries[entry] * state.s)
//                                                     + 0.0 * state.s
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program make_aggregations_sparse(ir::Program program, Report& report);

}  // namespace rddlc::passes
