// rddl verify: the same steps by all engines, to see whether they agree.
#include "verify/verify.hpp"

#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "support/json_text.hpp"
#include "support/program.hpp"
#include "terminal/interrupt.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <memory>

namespace rddlc::cli {

namespace {

struct VerifyOptions {
    ProblemArguments problem;
    std::optional<std::filesystem::path> policy_file;
    LoadOptions load;
    EngineChoice engines;
    VerifySettings settings;
    bool json = false, quiet = false;
};

ExitStatus verify(const VerifyOptions& options) {
    const auto begin = std::chrono::steady_clock::now();
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
    const OutcomeComparison comparison(problem.description());
    const VerifyReport report = verify_problem(problem, comparison, words, options.settings, begin);
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
                                    options.settings.steps, 1, std::int64_t{1} << 40);
    add_number_option<double>(command, "--seconds", "SECONDS",
                              "Time in total, as far as compiling leaves some (10)",
                              options.settings.seconds, 0.1, 1e6);
    add_seed_option(command, options.settings.seed, "Seed of all random numbers (0)");
    add_text_option(command, "--states", "FILE",
                    "Step from the states of this file instead: a trace, or lines for rddl replay",
                    options.settings.states);
    add_policy_option(command, options.settings.policy, options.policy_file);
}

void add_compared_options(Command& command, VerifyOptions& options) {
    add_option(
        command, "--engine", "ENGINE",
        "compiled (default): interpreters and compiled code; interpreter: needs no C++ "
        "compiler",
        [&options](const std::string& name) { options.engines.compiled = name == "compiled"; })
        .choices = {"compiled", "interpreter"};
    const auto add_lanes = [&options](const std::string& count) {
        options.engines.lanes.push_back(std::stoi(count));
    };
    add_list_option(
        command, "--lanes", "N,...",
        "Environments in a pack; each number is compiled by itself (as many as suit the "
        "problem)",
        add_lanes)
        .choices = {"1", "8", "16", "32", "64"};
    add_flag(command, "--no-pyrddlgym", "Leave out pyRDDLGym, which is compared if it is installed",
             [&options](const std::string&) { options.settings.pyrddlgym = false; });
    add_number_option<std::int64_t>(command, "--pyrddlgym-steps", "N",
                                    "Steps of pyRDDLGym, at most (200)",
                                    options.settings.pyrddlgym_steps, 1, 1'000'000);
    add_text_option(command, "--python", "PYTHON",
                    "Python that has pyRDDLGym (that of $VIRTUAL_ENV, else python3)",
                    options.settings.python.python);
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
    add_flag(command, "--json", "Print the results as JSON", options->json);
    add_flag(command, "--quiet", "Print nothing if all agree", options->quiet);
    command.run = [options] {
        options->load.quiet = options->quiet || options->json;
        options->settings.quiet = options->quiet;
        return verify(*options);
    };
    return command;
}

}  // namespace rddlc::cli
