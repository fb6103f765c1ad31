// How many objects a loop over few of them has (object_lanes/objects.hpp).
#pragma once

#include <cstdint>

namespace rddl {

inline constexpr std::int64_t most_few_objects = 16;

}  // namespace rddl
