// PPO as a training sees it.
#pragma once

#include "solvers/ppo/demonstrations.hpp"
#include "solvers/ppo/options.hpp"
#include "solvers/training/training.hpp"

namespace rddlc::solvers {

// The simulator must outlive it. A new run imitates what `demonstrate` shows, if it is not empty.
Trainee ppo_trainee(const rddl_simulator& simulator, const PpoOptions& options,
                    const Ranks& ranks = {}, const Demonstrate& demonstrate = {});

}  // namespace rddlc::solvers
