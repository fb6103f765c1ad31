// Tables of which few bools are true, of the state when an episode begins and of the action. Other
// states and actions have the same values and take longer.
#pragma once

#include "ir/ir.hpp"

#include <cstdint>

namespace rddlc::passes {

// Whether it is such a table: one bool at least is true, and one of `least_places` at most.
bool begins_with_few_true(const ir::Buffer& buffer, std::int64_t least_places);

// Whether it is such a table of the action: one bool of `least_places` at most is true.
bool acts_with_few_true(const ir::Buffer& buffer, std::int64_t least_places);

// `least_places` of loops and sums that visit the true bools alone.
inline constexpr std::int64_t least_per_visit = 16;
// `least_places` of loops that compute the chosen objects alone: one object alone takes about as
// long as that many in registers. The runtime computes all objects if an action chooses more.
inline constexpr std::int64_t least_per_chosen = 8;
// `least_places` of draws that wait for an action's choice: those of the chosen objects are made
// one by one, all others in registers.
inline constexpr std::int64_t least_per_draw = 2;

}  // namespace rddlc::passes
