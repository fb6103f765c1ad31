#pragma once

#include "support/diagnostic.hpp"

namespace rddlc::grounding {

inline constexpr Code not_supported_yet{'E', 601};
inline constexpr Code contradictory_bounds{'E', 602};
inline constexpr Code too_many_groundings{'E', 603};
inline constexpr Code too_much_memory{'E', 604};

inline constexpr Code certain_fault{'W', 601};

}  // namespace rddlc::grounding
