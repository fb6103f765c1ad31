// The first steps of an episode as text, the same whichever engine makes them.
#pragma once

#include <rddl/simulator.h>

#include <string>

namespace rddlc::testing {

// The initial state, then a line a step: the action (what is not default of it), the new state, the
// observation where there is one, the reward, how it ended. Actions are random but always the same.
std::string trace_of(const rddl_simulator& simulator);

}  // namespace rddlc::testing
