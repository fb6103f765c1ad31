// How many objects a loop over few of them has (object_lanes/objects.hpp).
#pragma once

#include <cstdint>

namespace rddl {

inline constexpr std::int64_t most_few_objects = 16;
// Half a register of AVX-512 holds the doubles of so many objects.
inline constexpr std::int64_t most_few_reals = 4;

}  // namespace rddl
