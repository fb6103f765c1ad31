// Finds the pass, or the emitted code, that makes a step wrong.
#pragma once

#include "ir/external_functions.hpp"
#include "ir/ir.hpp"
#include "passes/passes.hpp"
#include "rollouts/step_outcome.hpp"
#include "verify/verified_engine.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::workbench {

// A step that can be made again: where it starts, and its random numbers.
struct StepStart {
    bool initial = false;  // only the initial state of the episode is checked
    Record state, action;
    std::int64_t environment = 0;
    std::int64_t episode = 0;  // of that environment
    std::int64_t step = 0;     // of that episode
    // The observations of the policy block, if it is asked, from the first step on to this one.
    std::vector<Record> seen = {};
};

// The running passes: reports the program after each.
using TellProgram = std::function<void(std::string_view pass, const ir::Program&)>;
using Pipeline = std::function<void(ir::Program, const TellProgram&)>;
Pipeline pipeline_of(const PassOptions& options);

struct StepRepetition {
    const OutcomeComparison& comparison;
    const StepStart& start;
    std::uint64_t seed;
    Tolerance tolerance;
};

// The first pass after which the interpreter gives another outcome than before all of them.
std::optional<std::string> pass_to_blame(const ir::Program& plain, const Pipeline& pipeline,
                                         const ir::ExternalFunctions& functions,
                                         const StepRepetition& repetition);
// The first pass that makes no valid program, and what is wrong with it.
struct InvalidProgram {
    std::string pass, complaint;
};
std::optional<InvalidProgram> invalid_program(const ir::Program& plain, const Pipeline& pipeline);

// The step in the interpreter, directly. Its fault is text that only outcomes of this function
// share.
StepOutcome interpret_step(const ir::Program& program, const ir::ExternalFunctions& functions,
                           const StepStart& start, std::uint64_t seed);
// The same several times, with other last digits where another implementation may have them.
std::vector<StepOutcome> interpret_step_otherwise(const ir::Program& program,
                                                  const ir::ExternalFunctions& functions,
                                                  const StepStart& start, std::uint64_t seed);
// The step by an engine, in `count` environments that do the same. Nothing if it cannot be reached,
// since steps before it fault.
std::optional<StepOutcome> repeat_step(const VerifiedEngine& engine, std::int64_t count,
                                       const StepStart& start, std::uint64_t seed);

}  // namespace rddlc::workbench
