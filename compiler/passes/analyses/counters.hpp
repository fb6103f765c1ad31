// Ints of the state that count steps: nothing but their own value decides their next one.
//
//     epoch' = epoch + 1;     hour' = if (hour == 23) then 0 else hour + 1;
#pragma once

#include "ir/builder.hpp"
#include "vocabulary/range.hpp"

#include <map>

namespace rddlc::passes {

// The values that each counter has in an episode from the initial state to the horizon. It may have
// others, since callers set states and horizons.
std::map<ir::BufferId, Range> find_counters(ir::Builder& builder);

}  // namespace rddlc::passes
