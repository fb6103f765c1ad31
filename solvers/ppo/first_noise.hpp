// The noise that a run begins with.
#pragma once

#include "solvers/ppo/options.hpp"
#include "solvers/spaces/actions.hpp"
#include "solvers/spaces/observations.hpp"

#include <rddl/simulator.h>

namespace rddlc::solvers {

// Bounds may be far wider than what a system stands. Then noise of half their width shows nothing
// but ruin, and a run is too short for the deviation to shrink: Adam moves its logarithm by less
// than 1 in a million steps. The logarithm is 0, or -2 where an untrained policy with that noise
// loses more than ten times what no-op does. It is 0 where no-op has a return of 0, with which
// nothing can be compared.
double first_log_deviation(const rddl_simulator& simulator, const ObservationSpace& observations,
                           const ActionSpace& actions, const PpoOptions& options);

}  // namespace rddlc::solvers
