// The program for the intermediate values of a step (ir/details.hpp), made from the output of
// `ground`.
//
//     scratch.slope = f(state.x)                  observation.slope = f(state.x)
//     next.x = state.x + scratch.slope       =>   observation.precondition[c] = action.go[c] <= 1
//     forall c: action.go[c] <= 1
#pragma once

#include "ir/details.hpp"

#include <cstdint>

namespace rddlc {

// The table of a precondition with more entries has fewer variables.
inline constexpr std::int64_t most_condition_entries = 100'000;

ir::Details make_details(ir::Program program);

}  // namespace rddlc
