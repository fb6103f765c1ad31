// The memory estimate of PPO, made before any memory is allocated.
#pragma once

#include "solvers/ppo/model.hpp"
#include "solvers/ppo/options.hpp"

#include <rddl/simulator.h>

namespace rddlc::solvers {

// Bytes.
struct PpoMemory {
    double networks = 0;      // weights, their gradients and moments, and what threads compute with
    double files = 0;         // policies and checkpoints, while they are written
    double steps = 0;         // all that is kept of the steps between two updates
    double environments = 0;  // of a simulator, and what is known about each of them
    double all() const { return networks + files + steps + environments; }
};

// The estimate for a model whose networks are laid out; they need no parameters yet.
PpoMemory memory_of(const rddl_simulator& simulator, const PpoModel& model,
                    const PpoOptions& options);

// Throws a Failure with the sizes, and with what makes them smaller, where that is more than
// options.memory_limit.
void require_memory(const rddl_simulator& simulator, const PpoModel& model,
                    const PpoOptions& options);

// The options' rollout, halved as often as it takes to fit, and so that no update takes minutes;
// never so often that less than a minibatch is left. As it was where that does not suffice to fit.
int fitting_rollout(const rddl_simulator& simulator, const PpoModel& model,
                    const PpoOptions& options);

}  // namespace rddlc::solvers
