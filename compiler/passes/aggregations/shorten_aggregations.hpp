// The two passes without which sums over many objects are too long to be unrolled, for a program on
// which no others have run: factor_aggregations takes out what few variables change, and
// hoist_aggregations makes it once. Both leave only forms that `ground` makes as well.
#pragma once

#include "ir/ir.hpp"

namespace rddlc {

ir::Program shorten_aggregations(ir::Program program);

}  // namespace rddlc
