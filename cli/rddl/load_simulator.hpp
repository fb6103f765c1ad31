// A problem as a simulator, whichever engine runs it.
#pragma once

#include "passes/passes.hpp"
#include "problem_lookup.hpp"

#include <rddl/simulator.h>

#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

namespace rddlc::cli {

enum class Engine { Compiled, Interpreter };
std::string_view name_of(Engine engine);

struct LoadOptions {
    Engine engine = Engine::Compiled;
    bool ignore_cache = false;
    bool quiet = false;  // say nothing about compiling
    // Of external functions: C++ headers; for the interpreter shared objects, too.
    std::vector<std::filesystem::path> externs;
    PassOptions passes;
};

// Owns all that the simulator refers to: the loaded library, or program and sources.
using Simulator = std::shared_ptr<const rddl_simulator>;

struct LoadedProblem {
    ProblemFiles files;
    Simulator simulator;
};

// Prints the diagnostics and throws Diagnosed if there are errors; fails without a C++ compiler.
LoadedProblem load_problem(const ProblemFiles& files, const LoadOptions& options);

}  // namespace rddlc::cli
