#include "verify/verified_problem.hpp"

#include "driver/extern_headers.hpp"
#include "driver/shared_object.hpp"
#include "engines/compiled_simulator.hpp"
#include "engines/interpreted_simulator.hpp"
#include "problems/front_end.hpp"
#include "support/failure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rddlc::workbench {

namespace {

// Reals that --fast-math may round differently agree to this, relatively.
constexpr double rounding_tolerance = 1e-9;

constexpr std::size_t optimised = 1;  // index of the engine that compiled ones are compared with

struct Optimised {
    ir::Program program;
    std::vector<std::string> busy;  // in the order of their runs
};

Optimised optimise_watched(const ir::Program& plain, const PassOptions& options) {
    Optimised result;
    PassOptions watched = options;
    watched.observe = [&](const PassRun& run, const ir::Program&) {
        if (!run.report.empty() && std::ranges::count(result.busy, run.name) == 0)
            result.busy.emplace_back(run.name);
    };
    result.program = optimise(plain, watched);
    return result;
}

bool rounds(const std::string& name) {
    return std::ranges::any_of(all_passes(), [&](const PassDescription& pass) {
        return pass.name == name && pass.only_fast_math;
    });
}

// --without changes programs, and so does --fast-math; both are compared with the same plain one.
void add_interpreters(VerifiedProblem& problem) {
    Optimised made = optimise_watched(problem.plain, problem.load.passes);
    problem.busy_passes.assign(made.busy.rbegin(), made.busy.rend());
    std::ranges::copy_if(problem.busy_passes, std::back_inserter(problem.rounding), rounds);
    const bool fast_math = problem.load.passes.fast_math;
    const Tolerance tolerance{problem.rounding.empty() ? 0 : rounding_tolerance, fast_math};
    ir::Program plain = problem.plain;
    plain.moderate.reset();  // it takes no part in what is compared with it
    problem.engines.push_back(
        {.name = "plain interpreter",
         .simulator = interpreted_simulator(std::move(plain), problem.sources, problem.library)});
    problem.engines.push_back({.name = "interpreter after all passes",
                               .simulator = interpreted_simulator(std::move(made.program),
                                                                  problem.sources, problem.library),
                               .reference = 0,
                               .tolerance = tolerance});
}

Simulator compiled_with(const ProblemFiles& files, const LoadOptions& load) {
    const CompileOptions options = front_end_options(files, Stage::Emit, load);
    const Compilation compilation = compile_or_give_up(options);
    CacheOptions cache{files.name, load.ignore_cache, load.quiet, options.extern_headers};
    if (has_prepared_batches(load.lanes)) cache.linked_batches = options.real;
    return compiled_simulator(compilation.text, cache).simulator;
}

void add_compiled(VerifiedProblem& problem, std::optional<int> lanes, bool first) {
    LoadOptions load = problem.load;
    load.lanes = lanes;
    const Simulator simulator = problem.compile(load);
    const auto add = [&](std::string name, bool one_by_one, int lane_count) {
        problem.engines.push_back(
            {std::move(name), simulator, one_by_one, lane_count, true, optimised, Tolerance{}});
    };
    if (first) {
        add("compiled, single environments", true, 1);
        add("compiled, a batch", false, 1);
    }
    if (simulator->lane_count > 1)
        add(fmt::format("compiled, packs of {} ({})", simulator->lane_count,
                        simulator->instruction_set),
            false, simulator->lane_count);
}

}  // namespace

std::int64_t VerifiedProblem::environments() const {
    std::int64_t most = 16;
    for (const VerifiedEngine& engine : engines)
        most = std::max<std::int64_t>(most, engine.simulator->lane_count);
    return most + 3;
}

VerifiedProblem load_for_verification(const ProblemFiles& files, const LoadOptions& load,
                                      const EngineChoice& choice) {
    const ExternFiles externs = extern_files(load.externs);
    if (choice.compiled && !externs.shared_objects.empty())
        throw Failure(
            "the compiled engine takes external functions from a C++ header, not from a "
            "shared object",
            "name the header, or use --engine=interpreter", usage_error);
    CompileOptions options = compile_options(files, Stage::Verify);
    options.extern_headers = externs.headers;
    Compilation compilation = compile_or_give_up(options);
    if (load.externs.empty())
        report_undefined_externals(*compilation.program, {}, compilation.diagnostics);
    give_up_on_errors(compilation);
    VerifiedProblem problem{files,
                            load,
                            std::move(compilation.sources),
                            *std::move(compilation.program),
                            {},
                            pipeline_of(load.passes),
                            {},
                            {},
                            {},
                            {},
                            std::bind_front(compiled_with, files)};
    problem.library = external_library(problem.plain, files, load);
    problem.invalid = invalid_program(problem.plain, problem.pipeline);
    if (problem.invalid) return problem;
    add_interpreters(problem);
    if (!choice.compiled) return problem;
    if (choice.lanes.empty()) add_compiled(problem, std::nullopt, true);
    for (const int lanes : choice.lanes)
        add_compiled(problem, lanes, lanes == choice.lanes.front());
    return problem;
}

}  // namespace rddlc::workbench
