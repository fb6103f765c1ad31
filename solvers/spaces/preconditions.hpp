// Finds by trial what preconditions forbid: a simulator says whether an action is legal, not which
// other ones are.
#pragma once

#include "solvers/batches/stops.hpp"
#include "solvers/spaces/actions.hpp"
#include "solvers/spaces/groups.hpp"

#include <rddl/simulator.h>

#include <optional>
#include <vector>

namespace rddlc::solvers {

// Both end early, with "no", where `stops` says so.

// Whether any of some random actions, reals among them of the size that a learner begins with,
// violates a precondition in the states that they lead to.
bool preconditions_bite(const rddl_simulator& simulator, const ActionSpace& space,
                        const ActionRecords& records, const Stops& stops);

// Tries the groups that the parameters of the action-fluents suggest: the changes that concern the
// same object. They are taken if, in the states of some random episodes, random actions with one
// change in each group are legal, with the numbers that are drawn or else their defaults, and are
// not with one more; and if max-nondef-actions lets all of them change. Nothing if no such groups
// are found.
std::optional<Groups> find_groups(const rddl_simulator& simulator,
                                  const std::vector<rddl_column>& columns, const ActionSpace& space,
                                  const ActionRecords& records, const Stops& stops);

}  // namespace rddlc::solvers
