// Inputs of programs that are run for each action value by itself.
#pragma once

#include "solvers/cgp/scope.hpp"

#include <rddl/simulator.h>

namespace rddlc::solvers {

// Writes inputs, outputs, units and what units read. Reads scope.observations and scope.actions.
void lift(const rddl_simulator& simulator, ProgramScope& scope);

// Inputs with two bounds are read from -1 to 1.
void scale_by_bounds(ProgramInput& input, double lower, double upper);

}  // namespace rddlc::solvers
