#include "verify/verdict.hpp"

#include "terminal/interrupt.hpp"

#include <algorithm>
#include <chrono>

namespace rddlc::workbench {

namespace {

using Clock = std::chrono::steady_clock;

// The time of the search for the pass whose absence avoids an error of the emitted code.
constexpr std::chrono::seconds search_time{60};

// The first pass, from the last one on, without which the compiled engine agrees.
std::optional<std::string> find_avoiding_pass(const VerifiedProblem& problem,
                                              const OutcomeComparison& comparison,
                                              const Disagreement& found, std::uint64_t seed) {
    const VerifiedEngine& wrong = problem.engines[found.engine];
    const std::int64_t count = problem.environments();
    const auto expected = repeat_step(problem.engines[wrong.reference], count, found.start, seed);
    const auto agrees = [&](const VerifiedEngine& engine) {
        ValueCounts ignored;
        const auto outcome = repeat_step(engine, count, found.start, seed);
        return expected && outcome &&
               !comparison.compare(*expected, *outcome, problem.engines[wrong.reference].tolerance,
                                   ignored);
    };
    if (agrees(wrong)) return std::nullopt;  // it takes the other environments as they were
    const auto end = Clock::now() + search_time;
    for (const std::string& pass : problem.busy_passes) {
        if (Clock::now() > end || is_interrupted()) break;
        LoadOptions load = problem.load;
        load.passes.without.insert(pass);
        load.lanes = std::max(1, wrong.simulator->lane_count);
        VerifiedEngine other = wrong;
        other.simulator = problem.compile(load);
        if (agrees(other)) return pass;
    }
    return std::nullopt;
}

}  // namespace

Verdict judge(const VerifiedProblem& problem, const OutcomeComparison& comparison,
              const Disagreement& found, std::uint64_t seed) {
    Verdict verdict;
    const VerifiedEngine& engine = problem.engines[found.engine];
    if (engine.compiled) {
        verdict.emitted_code = true;
        verdict.avoided_by = find_avoiding_pass(problem, comparison, found, seed);
        return verdict;
    }
    verdict.pass = pass_to_blame(problem.plain, problem.pipeline, problem.library.functions,
                                 {comparison, found.start, seed, engine.tolerance});
    verdict.avoided_by = verdict.pass;
    return verdict;
}

}  // namespace rddlc::workbench
