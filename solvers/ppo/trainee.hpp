// PPO as a training sees it.
#pragma once

#include "solvers/ppo/options.hpp"
#include "solvers/training/training.hpp"

namespace rddlc::solvers {

// The simulator must outlive it.
Trainee ppo_trainee(const rddl_simulator& simulator, const PpoOptions& options,
                    const Ranks& ranks = {});

}  // namespace rddlc::solvers
