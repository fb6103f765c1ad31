// A number that tells the dynamics of problems apart.
#pragma once

#include "model/model.hpp"

#include <cstdint>

namespace rddlc::model {

// Of everything that a trajectory depends on: types and objects, fluents, non-fluents, the initial
// state and its draws, CPFs, reward, conditions, horizon and discount. Comments, layout and the
// policy block do not change it.
std::uint64_t fingerprint(const Model& model);

}  // namespace rddlc::model
