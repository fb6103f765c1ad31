// The number of environments in a pack, if the user does not choose it.
#pragma once

#include "ir/ir.hpp"

#include <array>
#include <string_view>

namespace rddlc::ir {

// The numbers that suitable_lane_count returns, beside 1 for no packs. rddl/batches.cpp has the
// code for them.
inline constexpr std::array suitable_lane_counts = {16, 64};

// The bools of a pack are the bits of one number, so a connective takes the same time for 64
// environments as for 16. Ints and reals take as many registers as their lanes need, and those of
// 64 lanes do not stay in registers. So a pack has 64 lanes where steps compute with bools nearly
// alone, if the nearest cache holds the action records of 64 environments. Draws do not count: as a
// rule few lanes need them. Nor do bools that a pack computes only where one of its actions chooses
// something, since 16 environments skip them more often than 64. A pack reads all of its action
// records: where a step reads few bools of many, or computes little for records that the nearest
// cache does not hold, each environment takes less time alone.
// docs/lanes.md has the measurements.
int suitable_lane_count(const Program& program);

// Whether packs of 64 environments with ints of a byte suit a program whose ints are that small:
// where steps compute with bools and ints nearly alone, as above, and not with bools alone.
bool suits_byte_ints(const Program& program);

// Why steps of this program compute one environment at a time, whatever the number of lanes, as
// "with a policy block"; empty if they need not.
std::string_view why_without_packs(const Program& program);

}  // namespace rddlc::ir
