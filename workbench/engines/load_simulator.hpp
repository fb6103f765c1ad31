// A problem as a simulator, whichever engine runs it.
#pragma once

#include "driver/driver.hpp"
#include "emit/emit.hpp"
#include "engines/background_build.hpp"
#include "passes/passes.hpp"
#include "problems/problem_lookup.hpp"
#include "solvers/gradients/step_derivatives.hpp"
#include "support/files.hpp"

#include <rddl/simulator.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace rddlc::workbench {

// Auto starts with the interpreter, and changes to the compiled engine when that is ready in the
// background. All compute the same bits.
enum class Engine { Auto, Compiled, Interpreter };
std::string_view name_of(Engine engine);  // "auto", ...
std::optional<Engine> engine_named(std::string_view name);

struct LoadOptions {
    Engine engine = Engine::Auto;
    bool ignore_cache = false;
    bool quiet = false;  // say nothing about compiling
    // Called with the problem's name before it is compiled, unless in the background; empty: a
    // terminal shows it.
    std::function<void(const std::string&)> on_compiling = {};
    // Files of external functions: C++ headers; for the interpreter also shared objects.
    std::vector<std::filesystem::path> externs;
    PassOptions passes;
    RealType real = RealType::Double;  // of the compiled engine
    std::optional<int> lanes;          // CompileOptions::lane_count
    bool details = false;              // get_interm, and objects in explain_violation
    bool remembers = false;            // for load_known
};

// Owns all that the simulator refers to: the loaded library, or program and sources.
using Simulator = std::shared_ptr<const rddl_simulator>;

// The cost of getting from the files to the simulator.
struct LoadCosts {
    double compile_seconds = 0;  // by rddlc: to the emitted text, or to what is interpreted
    std::optional<double> build_seconds;  // by the C++ compiler; nothing without it, or if it was
                                          // spared since the object was in the cache
    double load_seconds = 0;              // all in all
    std::int64_t emitted_lines = 0, emitted_bytes = 0;  // 0 with the interpreter, and so
    std::int64_t object_bytes = 0;                      // is this
};

struct LoadedProblem {
    ProblemFiles files;
    Simulator simulator;
    LoadCosts costs;
    UsedFiles used = {};  // all that was read for it
    bool is_compiled = false;
    // The build of Engine::Auto, unless the simulator is compiled already.
    std::shared_ptr<BackgroundBuild> background = {};
    // Derivatives of steps; the problem is compiled again when they are asked for first.
    solvers::DerivativesSource derivatives = {};
};

// The engine in place of Auto where that has to wait for the C++ compiler anyway: external
// functions need it, and the interpreter computes with doubles alone.
Engine engine_of(const LoadOptions& options);

// To compile the problem up to a stage, as it is loaded.
CompileOptions front_end_options(const ProblemFiles& files, Stage last, const LoadOptions& options);

// The compilation from which the engine makes a simulator; its diagnostics say whether it can.
Compilation compile_problem(const ProblemFiles& files, const LoadOptions& options);
// Loads a compilation without errors. Fails without a C++ compiler. Costs are those after
// compiling; load_seconds is 0.
LoadedProblem load_compilation(Compilation compilation, const ProblemFiles& files,
                               const LoadOptions& options);

// The compiled simulator of these files, if one that remembers was loaded before and nothing has
// changed since: in a tenth of the time. Warnings are not reported again. Nothing if the problem
// must be compiled: problems with external functions always.
std::optional<LoadedProblem> load_known(const ProblemFiles& files, const LoadOptions& options);

// Compiles and loads. Prints the diagnostics and throws Diagnosed if there are errors. Of warnings,
// prints those in the policy's own file.
LoadedProblem load_problem(const ProblemFiles& files, const LoadOptions& options);

}  // namespace rddlc::workbench
