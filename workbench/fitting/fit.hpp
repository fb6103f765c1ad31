// Non-fluents from recorded steps: nonlinear least squares of what each step leads to.
#pragma once

#include "engines/load_simulator.hpp"
#include "problems/problem_lookup.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace rddlc::workbench {

struct FitOptions {
    std::vector<std::string> parameters;  // names of real non-fluents
    std::vector<std::filesystem::path> traces;
    int draws = 16;  // whose mean is what a step is expected to lead to, where anything is drawn
    int iterations = 100;
    std::uint64_t seed = 0;            // of the draws
    std::function<bool()> stops = {};  // asked often; true ends the search early
};

struct FittedParameter {
    std::string name;  // a grounding, "GAIN___r1"
    double start, value;
    double error;  // a standard error, by Laplace's approximation
};

struct Fit {
    std::vector<FittedParameter> parameters;
    std::int64_t steps = 0;
    std::int64_t faulted = 0;  // recorded steps that were left out, since they faulted
    bool interrupted = false;  // values are those so far; errors are not known
    double error_before = 0, error_after = 0;  // root of the mean squared, scaled residual
    int iterations = 0;
    bool has_converged = false;  // else FitOptions::iterations ended the search
};

// Levenberg's and Marquardt's method (1944, 1963): real values of the next state and the reward, as
// the traces have them, minus those that the state and the action of the step lead to, each scaled
// by its deviation. A line without a reward takes part by its next state alone. Throws Failure
// where there are no data, a line is not a transition, or a parameter has no influence.
Fit fit(const ProblemFiles& files, const LoadOptions& load, const rddl_simulator& simulator,
        const FitOptions& options);

}  // namespace rddlc::workbench
