// Deep reactive policies as a training sees them.
#pragma once

#include "solvers/drp/options.hpp"
#include "solvers/gradients/step_derivatives.hpp"
#include "solvers/training/training.hpp"

namespace rddlc::solvers {

// The simulator must outlive it.
Trainee drp_trainee(const rddl_simulator& simulator, const DrpOptions& options,
                    const DerivativesSource& derivatives);

}  // namespace rddlc::solvers
