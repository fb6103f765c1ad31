// Actions that violate a precondition, made legal.
#pragma once

#include "solvers/spaces/actions.hpp"

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>

namespace rddlc::solvers {

// Values at fault fall back toward their default: a real by halves at first, then all the way.
// Which values are at fault is found by asking about actions of which only the first ones are set.
// Where not even the default action is legal, an action stays as it is.
//
// `actions` are rows of values, `records` the same as records; both are changed. The last two are
// for work: a number an environment, and rows as `actions`. Returns how many actions were illegal.
std::int64_t mend_actions(const rddl_simulator& simulator, const ActionSpace& space,
                          const ActionRecords& converter, rddl_batch* batch,
                          std::int64_t environments, float* actions, std::byte* records,
                          std::int32_t* violated, float* wanted);

}  // namespace rddlc::solvers
