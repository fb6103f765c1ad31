// A number that distinguishes the dynamics of problems.
#pragma once

#include "model/model.hpp"

#include <cstdint>

namespace rddlc::model {

// The fingerprint of everything that a trajectory depends on: types and objects, fluents,
// non-fluents, the initial state and its draws, CPFs, reward, conditions, horizon and discount.
// Comments, layout and the policy block do not change it.
std::uint64_t fingerprint(const Model& model);

}  // namespace rddlc::model
