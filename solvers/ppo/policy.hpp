// The policy that PPO has learned.
#pragma once

#include "solvers/policies/policy.hpp"
#include "solvers/ppo/model.hpp"

#include <rddl/simulator.h>

#include <cstdint>
#include <memory>
#include <string>

namespace rddlc::solvers {

// Chooses what is likeliest, or at random as it has learned. The simulator must outlive it.
Policy ppo_policy(const rddl_simulator& simulator, std::shared_ptr<const PpoModel> model,
                  bool random, std::uint64_t seed, std::string name);

}  // namespace rddlc::solvers
