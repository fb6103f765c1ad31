// rddl verify: the same steps by all engines, to see whether they agree.
#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "support/json_text.hpp"
#include "support/program.hpp"
#include "terminal/interrupt.hpp"
#include "verify/pyrddlgym_outcomes.hpp"
#include "verify/verdict.hpp"
#include "verify/verified_problem.hpp"
#include "verify/verify_report.hpp"
#include "verify/walk_in_step.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>

namespace rddlc::cli {

namespace {

using Clock = std::chrono::steady_clock;

// The time for stepping if compiling takes long, and pyRDDLGym's share.
constexpr double least_seconds = 2;
constexpr double pyrddlgym_share = 0.25;

struct VerifyOptions {
    ProblemArguments problem;
    std::optional<std::filesystem::path> policy_file;
    LoadOptions load;
    EngineChoice engines;
    Policy policy = Policy::Random;
    std::int64_t steps = 20'000;
    double seconds = 10;
    std::uint64_t seed = 0;
    std::string states;
    bool pyrddlgym = true;
    PyRddlGymOptions python;
    std::int64_t pyrddlgym_steps = 200;
    bool json = false, quiet = false;
};

Clock::duration duration(double seconds) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

void require_policy(const VerifiedProblem& problem) {
    if (!problem.engines.front().simulator->policy)
        throw Failure("there is no policy block in the files of the problem",
                      "name the file that has it: --policy=FILE.rddl");
}

Walk walk(const VerifiedProblem& problem, const OutcomeComparison& comparison,
          const VerifyOptions& options, Clock::time_point begin) {
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

std::optional<PyRddlGymComparison> ask_pyrddlgym(const VerifyOptions& options,
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

ExitStatus verify(const VerifyOptions& options) {
    const auto begin = Clock::now();
    ProblemFiles files = options.problem.files();
    files.policy = options.policy_file;
    const VerifiedProblem problem = load_for_verification(files, options.load, options.engines);
    const std::string words = options.problem.first +
                              (options.problem.second.empty() ? "" : " " + options.problem.second);
    if (problem.invalid) {
        print("{}", options.json ? json_document(invalid_program_json(problem))
                                 : invalid_program_text(problem, words));
        return diagnosed;
    }
    if (options.policy == Policy::Rddl) require_policy(problem);
    const OutcomeComparison comparison(problem.description());
    VerifyReport report{
        problem, comparison, words, options.seed, walk(problem, comparison, options, begin),
        {},      {}};
    if (report.walk.disagreement)
        report.verdict = judge(problem, comparison, *report.walk.disagreement, options.seed);
    report.pyrddlgym = ask_pyrddlgym(options, problem, comparison, report.walk, begin);
    if (options.json)
        print("{}", json_document(report_json(report)));
    else if (!report.agrees())
        print("{}", difference_text(report));
    else if (!options.quiet)
        print("{}", agreement_line(report));
    if (!report.agrees()) return diagnosed;
    if (!report.walk.interrupted) return success;
    tell("rddl: interrupted before all was compared\n");
    return interrupted_status();
}

void add_amount_options(Command& command, VerifyOptions& options) {
    add_number_option<std::int64_t>(command, "--steps", "N", "Steps, at most (20000)",
                                    options.steps, 1, std::int64_t{1} << 40);
    add_number_option<double>(command, "--seconds", "SECONDS",
                              "Time in total, as far as compiling leaves some (10)",
                              options.seconds, 0.1, 1e6);
    add_seed_option(command, options.seed, "Seed of all random numbers (0)");
    add_text_option(command, "--states", "FILE",
                    "Step from the states of this file instead: a trace, or lines for rddl replay",
                    options.states);
    add_policy_option(command, options.policy, options.policy_file);
}

void add_compared_options(Command& command, VerifyOptions& options) {
    add_option(
        command, "--engine", "ENGINE",
        "compiled (default): interpreters and compiled code; interpreter: needs no C++ "
        "compiler",
        [&options](const std::string& name) { options.engines.compiled = name == "compiled"; })
        .choices = {"compiled", "interpreter"};
    const auto add_lanes = [&options, is_first = true](const std::string& count) mutable {
        if (is_first) options.engines.lanes.clear();
        is_first = false;
        options.engines.lanes.push_back(std::stoi(count));
    };
    add_list_option(command, "--lanes", "N,...",
                    "Environments in a pack; each number is compiled by itself (16)", add_lanes)
        .choices = {"1", "8", "16", "32", "64"};
    add_flag(command, "--no-pyrddlgym", "Leave out pyRDDLGym, which is compared if it is installed",
             [&options](const std::string&) { options.pyrddlgym = false; });
    add_number_option<std::int64_t>(command, "--pyrddlgym-steps", "N",
                                    "Steps of pyRDDLGym, at most (200)", options.pyrddlgym_steps, 1,
                                    1'000'000);
    add_text_option(command, "--python", "PYTHON",
                    "Python that has pyRDDLGym (that of $VIRTUAL_ENV, else python3)",
                    options.python.python);
}

}  // namespace

Command verify_command() {
    const auto options = std::make_shared<VerifyOptions>();
    Command command;
    command.name = "verify";
    command.summary = "Step the problem by all engines and compare all values";
    command.details =
        "All engines make the same steps, from states of episodes and from random states: the\n"
        "interpreter without and with all optimisations, and the compiled code, one environment\n"
        "by itself and packs of them. Status 0: all agree, 1: they differ; the first difference\n"
        "is shown with its CPF and the optimisation that causes it. See docs/verify.md.\n\n"
        "Examples:\n"
        "  rddl verify domain.rddl instance.rddl\n"
        "  rddl verify SysAdmin_MDP_ippc2011 1 --steps 1000000 --seconds 600 --lanes 1,8,16\n"
        "  rddl verify domain.rddl instance.rddl --states trace.jsonl --json";
    add_problem_arguments(command, options->problem);
    add_amount_options(command, *options);
    add_compared_options(command, *options);
    add_extern_option(command, options->load,
                      "C++ header of the external functions; the interpreter also takes a .so");
    add_pass_options(command, options->load);
    add_cache_option(command, options->load);
    add_flag(command, "--json", "Print what was found as JSON", options->json);
    add_flag(command, "--quiet", "Print nothing if all agree", options->quiet);
    command.run = [options] {
        options->load.quiet = options->quiet || options->json;
        return verify(*options);
    };
    return command;
}

}  // namespace rddlc::cli
