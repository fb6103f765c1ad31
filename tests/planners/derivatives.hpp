// Derivatives of a problem whose folder holds its text.
#pragma once

#include "engines/step_derivatives.hpp"

#include <filesystem>

namespace rddlc::planners {

inline solvers::DerivativesSource derivatives_in(const std::filesystem::path& folder) {
    workbench::ProblemFiles files;
    files.name = folder.string();
    files.domain = folder / "domain.rddl";
    files.instance = folder / "instance.rddl";
    return workbench::derivatives_of(files, {});
}

}  // namespace rddlc::planners
