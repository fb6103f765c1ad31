// Exact derivatives of a problem's steps, from its files.
#pragma once

#include "engines/load_simulator.hpp"
#include "problems/problem_lookup.hpp"
#include "solvers/gradients/step_derivatives.hpp"

#include <filesystem>
#include <map>
#include <string>

namespace rddlc::workbench {

// The source compiles the problem when it is called first, and keeps what it has found. It throws a
// Failure where the problem has no derivatives. `texts` replace what files hold, by their paths.
solvers::DerivativesSource derivatives_of(const ProblemFiles& files, const LoadOptions& options,
                                          std::map<std::filesystem::path, std::string> texts = {});

}  // namespace rddlc::workbench
