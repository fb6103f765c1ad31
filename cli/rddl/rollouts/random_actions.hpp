// Random legal actions, as the solvers have them.
#pragma once

#include "solvers/policies/random_actions.hpp"

namespace rddlc::cli {

using solvers::RandomActions;
using solvers::RandomPolicy;

}  // namespace rddlc::cli
