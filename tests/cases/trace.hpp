// The first steps of an episode as text, the same whichever engine makes them.
#pragma once

#include <rddl/simulator.h>

#include <string>

namespace rddlc::testing {

// The initial state, then a line a step: the action (what is not default of it), the new state, the
// observation where there is one, the reward, how it ended. Actions are random but always the same.
std::string trace_of(const rddl_simulator& simulator);

// The first difference between two simulators of a problem, of which the second one steps single
// environments and packs; empty without one. In some steps no environment chooses anything, or
// one alone.
std::string difference_in_batches(const rddl_simulator& expected, const rddl_simulator& found);

}  // namespace rddlc::testing
