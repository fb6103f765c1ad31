// The optimisations. Each keeps the value of every fluent bit for bit. Those that run with
// --fast-math only keep less (docs/fast-math.md).
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc {

// The part of a program that a pass works on; also the folder that it stands in.
enum class Phase : std::uint8_t { Constants, Arithmetic, Aggregations, Sharing, Lanes };
std::string_view name_of(Phase phase);  // "constants"

struct PassDescription {
    std::string_view name;
    Phase phase;
    std::string_view summary;             // what it does
    std::vector<std::string_view> after;  // passes that have to run before it
    std::string_view because;             // why it stands where it stands
    bool only_fast_math;                  // runs only with PassOptions::fast_math
};
// The passes in the order in which they run first; each once.
std::vector<PassDescription> all_passes();
// The pipeline as a text: a paragraph for each pass.
std::string pipeline_text();

// The postcondition of a pass: whether a second run would change nothing, or cost more. Throws
// std::out_of_range if there is no pass of that name.
bool is_finished(std::string_view pass, const ir::Program& program);

// How large a program is.
struct ProgramSize {
    std::size_t nodes;
    double
        operations;  // of one step with the reward and the tests of the new state; ir::cost_of_step
};
ProgramSize size_of(const ir::Program& program);

// One run of one pass.
struct PassRun {
    std::string_view name;
    passes::Report report;
    bool undone;  // a step would cost more (ir/cost_model.hpp), so the program stays as it was
    ProgramSize before, after;
    std::chrono::duration<double> time;
};

struct PassOptions {
    // Names of passes that are left out. Those whose results emit/ needs run in any case.
    std::set<std::string, std::less<>> without;
    bool fast_math = false;  // --fast-math
    // Called after each run of a pass with its result: first for the program for any values, then
    // for the one for moderate values (ir::Program::only_moderate).
    std::function<void(const PassRun&, const ir::Program&)> observe = {};
};

// Runs all passes, in the order that passes.cpp lists; also on the program for moderate values, if
// there is one. It stays only if passes could leave out more there. The runs on the program that
// makes most steps are added to `runs`.
ir::Program optimise(ir::Program program, const PassOptions& options = {},
                     std::vector<PassRun>* runs = nullptr);

}  // namespace rddlc
