// A problem as a simulator, whichever engine runs it.
#pragma once

#include "front_end.hpp"
#include "problem_lookup.hpp"

#include <rddl/simulator.h>

#include <memory>
#include <string_view>

namespace rddlc::cli {

enum class Engine { Compiled, Interpreter };
std::string_view name_of(Engine engine);

struct LoadOptions {
    Engine engine = Engine::Compiled;
    bool ignore_cache = false;
    bool quiet = false;  // say nothing about compiling
};

// Owns all that the simulator refers to: the loaded library, or program and sources.
using Simulator = std::shared_ptr<const rddl_simulator>;

struct LoadedProblem {
    ProblemFiles files;
    Simulator simulator;
};

// Prints the diagnostics and throws Diagnosed if there are errors; Failure if there is no C++
// compiler or it fails.
LoadedProblem load_problem(const ProblemFiles& files, const LoadOptions& options);

// From the checked problem, which is used up.
Simulator load_simulator(CheckedProblem problem, const LoadOptions& options);

}  // namespace rddlc::cli
