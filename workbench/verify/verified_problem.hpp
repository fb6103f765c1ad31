// A problem as all the engines that are compared: by the plain program, the optimised one, and the
// emitted code.
#pragma once

#include "engines/external_library.hpp"
#include "ir/ir.hpp"
#include "support/source.hpp"
#include "verify/blame_pass.hpp"
#include "verify/verified_engine.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rddlc::workbench {

// The compiled simulator of other options.
using CompileAgain = std::function<Simulator(const LoadOptions& load)>;

struct VerifiedProblem {
    ProblemFiles files;
    LoadOptions load;
    Sources sources;
    ir::Program plain;  // before all passes
    ExternalLibrary library;
    Pipeline pipeline;                      // from the plain program to the optimised one
    std::vector<std::string> busy_passes;   // that changed something, each once, the last first
    std::vector<std::string> rounding;      // those of them that may round reals differently
    std::optional<InvalidProgram> invalid;  // then the problem has no engines
    std::vector<VerifiedEngine> engines;  // the plain interpreter, the optimised one, compiled ones
    CompileAgain compile;

    const rddl_problem& description() const { return *engines.front().simulator->problem; }
    // So many that packs are filled, and others in part.
    std::int64_t environments() const;
};

struct EngineChoice {
    bool compiled = true;
    // A compilation for each; empty: one with as many as suit the problem.
    std::vector<int> lanes = {};
};

// Prints the diagnostics and throws Diagnosed if there are errors.
VerifiedProblem load_for_verification(const ProblemFiles& files, const LoadOptions& load,
                                      const EngineChoice& choice);

}  // namespace rddlc::workbench
