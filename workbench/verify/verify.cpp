#include "verify/verify.hpp"

#include <algorithm>
#include <chrono>

namespace rddlc::workbench {

namespace {

using Clock = std::chrono::steady_clock;

// The time for stepping if compiling takes long, and pyRDDLGym's share.
constexpr double least_seconds = 2;
constexpr double pyrddlgym_share = 0.25;

Clock::duration duration(double seconds) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

void require_policy(const VerifiedProblem& problem) {
    if (!problem.engines.front().simulator->policy)
        throw Failure("there is no policy block in the files of the problem",
                      "name the file that has it: --policy=FILE.rddl");
}

Walk walk(const VerifiedProblem& problem, const OutcomeComparison& comparison,
          const VerifySettings& options, Clock::time_point begin) {
    WalkOptions walk;
    walk.environments = problem.environments();
    walk.seed = options.seed;
    walk.steps = options.steps;
    const double share = options.pyrddlgym ? 1 - 2 * pyrddlgym_share : 1;
    walk.end = std::max(begin + duration(share * options.seconds),
                        Clock::now() + duration(std::min(least_seconds, options.seconds)));
    walk.policy = options.policy;
    walk.progress = !options.quiet;
    if (options.pyrddlgym) walk.most_samples = static_cast<std::size_t>(options.pyrddlgym_steps);
    if (!options.states.empty()) {
        const VerifiedEnvironments fresh(problem.engines.front(), 1, options.seed, 0);
        walk.recorded = read_states(options.states, problem.description(), fresh.state(0));
    }
    return walk_in_step(problem.engines, comparison, walk);
}

std::optional<PyRddlGymComparison> ask_pyrddlgym(const VerifySettings& options,
                                                 const VerifiedProblem& problem,
                                                 const OutcomeComparison& comparison,
                                                 const Walk& walk, Clock::time_point begin) {
    if (!options.pyrddlgym || walk.disagreement || walk.interrupted) return std::nullopt;
    PyRddlGymComparison excused;
    if (!problem.plain.externals.empty())
        excused.not_compared = "the problem calls external functions";
    else if (problem.files.standard != Standard::PyRddlGym)
        excused.not_compared = "it does not read --std=rddlc";
    if (!excused.not_compared.empty()) return excused;
    PyRddlGymOptions python = options.python;
    const double left =
        std::chrono::duration<double>(begin + duration(options.seconds) - Clock::now()).count();
    python.seconds = std::max(left, pyrddlgym_share * options.seconds);
    python.rounded_otherwise = [&](const StepStart& start) {
        return interpret_step_otherwise(problem.plain, problem.library.functions, start,
                                        options.seed);
    };
    return compare_with_pyrddlgym(problem.files, problem.description(), comparison, walk.samples,
                                  python);
}

}  // namespace

VerifyReport verify_problem(const VerifiedProblem& problem, const OutcomeComparison& comparison,
                            const std::string& words, const VerifySettings& options,
                            std::chrono::steady_clock::time_point begin) {
    if (options.policy == Policy::Rddl) require_policy(problem);
    VerifyReport report{
        problem, comparison, words, options.seed, walk(problem, comparison, options, begin),
        {},      {}};
    if (report.walk.disagreement)
        report.verdict = judge(problem, comparison, *report.walk.disagreement, options.seed);
    report.pyrddlgym = ask_pyrddlgym(options, problem, comparison, report.walk, begin);
    return report;
}

}  // namespace rddlc::workbench
