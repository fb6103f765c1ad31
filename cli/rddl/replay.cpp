// rddl replay: steps that a file or another program asks for, line by line.
#include "commands.hpp"
#include "interrupt.hpp"
#include "line_stream.hpp"
#include "options.hpp"
#include "replay_session.hpp"

namespace rddlc::cli {

namespace {

struct ReplayCommandOptions {
    ProblemArguments problem;
    LoadOptions load;
    ReplayOptions session;
    std::string input = "-";
    std::string output = "-";
};

ExitStatus replay(const ReplayCommandOptions& options) {
    const LoadedProblem problem = load_problem(options.problem.files(), options.load);
    LineReader input(options.input);
    LineWriter output(options.output);
    ReplaySession session(*problem.simulator, options.session);
    while (const auto line = input.next()) output.write(session.answer(*line));
    output.flush();
    return is_interrupted() ? interrupted : success;
}

}  // namespace

Command add_replay_command(CLI::App& program) {
    CLI::App* const app =
        program.add_subcommand("replay", "Make the steps that lines of JSON ask for");
    app->footer(
        "An input line is {\"action\": {...}, \"state\": {...}}, both optional; the state (or a\n"
        "part of it) is set before the step. The answer is {\"state\": {...}, \"observation\":\n"
        "{...} or null, \"reward\": r, \"terminated\": b, \"truncated\": b}, or {\"error\": "
        "\"...\"}\n"
        "for a line that is refused. docs/traces.md tells all members. A trace of 'rddl run' is\n"
        "an input, too. In a pipe every answer comes at once, so a program can drive this.\n\n"
        "Examples:\n"
        "  rddl replay domain.rddl instance.rddl --input actions.jsonl --output trace.jsonl\n"
        "  echo '{\"action\": {\"throttle\": 1.0}}' | rddl replay domain.rddl instance.rddl\n"
        "  echo '{\"repeat\": 1000}' | rddl replay SysAdmin_MDP_ippc2011 1 --seed 3");
    const auto options = std::make_shared<ReplayCommandOptions>();
    add_problem_arguments(*app, options->problem);
    app->add_option("--input", options->input, "Lines of JSON; - (default) is standard input")
        ->type_name("FILE");
    app->add_option("--output", options->output, "Answers; - (default) is standard output")
        ->type_name("FILE");
    app->add_option("--seed", options->session.seed,
                    "Seed of all random numbers (the input's if it is a trace, else 0)")
        ->check(CLI::NonNegativeNumber.description(""))
        ->type_name("S");
    app->add_option("--horizon", options->session.horizon,
                    "Steps an episode; 0: no horizon (the trace's or the instance's)")
        ->check(CLI::NonNegativeNumber.description(""))
        ->type_name("H");
    app->add_flag("--enforce-preconditions", options->session.enforce_preconditions,
                  "Refuse actions that violate an action-precondition");
    add_engine_options(*app, options->load);
    return {app, [options] {
                return replay(*options);
            }};
}

}  // namespace rddlc::cli
