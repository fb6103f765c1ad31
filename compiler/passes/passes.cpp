#include "passes/passes.hpp"

#include "ir/analysis.hpp"
#include "ir/cost_model.hpp"
#include "ir/verify.hpp"
#include "passes/pipeline.hpp"
#include "passes/sharing/remove_unused_buffers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <span>
#include <stdexcept>
#include <utility>

namespace rddlc {

using passes::Pass;
using passes::pipeline;

std::string_view name_of(Phase phase) {
    constexpr std::string_view names[] = {"constants", "arithmetic", "aggregations", "sharing",
                                          "lanes"};
    return names[static_cast<std::size_t>(phase)];
}

namespace {

std::vector<std::string_view> names_in(std::span<const char* const> after) {
    std::vector<std::string_view> names;
    for (const char* const name : after)
        if (name) names.emplace_back(name);
    return names;
}

}  // namespace

std::vector<PassDescription> all_passes() {
    std::vector<PassDescription> passes;
    for (const Pass& pass : pipeline()) {
        const auto known = std::ranges::find(passes, pass.name, &PassDescription::name);
        if (known != passes.end()) continue;  // it runs again
        passes.push_back({pass.name, pass.phase, pass.summary, names_in(pass.after), pass.because,
                          pass.has(passes::only_fast_math)});
    }
    return passes;
}

std::string pipeline_text() {
    std::string text;
    for (const Pass& pass : pipeline()) {
        const auto after = names_in(pass.after);
        const std::string place =
            after.empty() ? "first" : fmt::format("after {}", fmt::join(after, " and "));
        text += fmt::format("{} ({}{})\n    {}\n    {}: {}\n", pass.name, name_of(pass.phase),
                            pass.has(passes::only_fast_math) ? "; only with --fast-math" : "",
                            pass.summary, place, pass.because);
    }
    return text;
}

ProgramSize size_of(const ir::Program& program) {
    const std::vector<bool> reachable = ir::reachable_nodes(program);
    return {.nodes = static_cast<std::size_t>(std::ranges::count(reachable, true)),
            .operations = ir::cost_of_step(program)};
}

namespace {

// Runs a pass on the program, which has `size`. The program stays as it was if a step of the result
// costs more, and the run says so, unless the emitter needs the pass or it adds tests.
PassRun run_pass(const Pass& pass, ir::Program& program, const ProgramSize& size) {
    PassRun run{
        .name = pass.name, .report = {}, .undone = false, .before = size, .after = {}, .time = {}};
    const auto begin = std::chrono::steady_clock::now();
    ir::Program made = pass.run(program, run.report);  // constant tables are shared
    run.time = std::chrono::steady_clock::now() - begin;
    run.after = size_of(made);
    run.undone = run.after.operations > size.operations && !pass.has(passes::always_runs) &&
                 !pass.has(passes::adds_tests);
    if (run.undone) {
        run.after = size;
        run.report.clear();
    } else {
        program = std::move(made);
    }
    return run;
}

const Pass& pass_named(std::string_view name) {
    const auto pass = std::ranges::find(pipeline(), name, &Pass::name);
    if (pass == pipeline().end()) throw std::out_of_range(std::string(name));
    return *pass;
}

// Adds what the passes did to `runs`.
ir::Program run_passes(ir::Program program, const PassOptions& options,
                       std::vector<PassRun>& runs) {
    ProgramSize size = size_of(program);
    for (const Pass& pass : pipeline()) {
        if (options.without.contains(pass.name) && !pass.has(passes::always_runs)) continue;
        if (pass.has(passes::only_fast_math) && !options.fast_math) continue;
        PassRun run = run_pass(pass, program, size);
        size = run.after;
        if (options.observe) options.observe(run, program);
        runs.push_back(std::move(run));
#ifndef NDEBUG
        ir::expect_valid(program, pass.name);
#endif
    }
    return program;
}

// How often passes left out what is multiplied by zero.
std::int64_t terms_left_out(const std::vector<PassRun>& runs) {
    std::int64_t count = 0;
    for (const PassRun& run : runs) {
        if (!pass_named(run.name).has(passes::leaves_out_zeros)) continue;
        for (const auto& [what, times] : run.report) count += times;
    }
    return count;
}

// The step and the reward, and the tables that they read.
ir::Program step_alone(ir::Program program) {
    program.preconditions.clear();
    program.invariants.clear();
    program.terminations.clear();
    program.reset.clear();
    passes::Report unused;
    return passes::remove_unused_buffers(std::move(program), unused);
}

}  // namespace

bool is_finished(std::string_view name, const ir::Program& program) {
    const Pass& pass = pass_named(name);
    ir::Program again = program;
    const PassRun run = run_pass(pass, again, size_of(program));
    return run.undone || pass.has(passes::may_find_more) ||
           std::ranges::all_of(run.report, [](const auto& did) { return did.second == 0; });
}

ir::Program optimise(ir::Program program, const PassOptions& options, std::vector<PassRun>* runs) {
    auto moderate = std::exchange(program.moderate, std::nullopt);
    // All values are taken to be moderate then.
    if (options.fast_math && moderate) {
        program = std::move(**moderate);
        moderate.reset();
    }
    std::vector<PassRun> made;
    program = run_passes(std::move(program), options, made);
    if (moderate) {
        std::vector<PassRun> made_of_moderate;
        ir::Program other = run_passes(std::move(**moderate), options, made_of_moderate);
        if (terms_left_out(made_of_moderate) > terms_left_out(made)) {
            other.only_in_packs = ir::cost_of_step(other) > ir::cost_of_step(program);
            program.moderate = step_alone(std::move(other));
            made = std::move(made_of_moderate);
        }
    }
    if (runs) std::ranges::move(made, std::back_inserter(*runs));
    return program;
}

}  // namespace rddlc
