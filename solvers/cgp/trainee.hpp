// CGP as a training sees it.
#pragma once

#include "solvers/cgp/search.hpp"
#include "solvers/training/training.hpp"

namespace rddlc::solvers {

// The simulator must outlive it.
Trainee cgp_trainee(const rddl_simulator& simulator, const CgpOptions& options,
                    const Ranks& ranks = {});

}  // namespace rddlc::solvers
