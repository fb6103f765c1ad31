// The options of PPO.
#pragma once

#include "solvers/options/options.hpp"
#include "solvers/ppo/options.hpp"

namespace rddlc::solvers {

// The preset comes first: callers apply several options in the order of the table.
const OptionTable<PpoOptions>& ppo_option_table();

}  // namespace rddlc::solvers
