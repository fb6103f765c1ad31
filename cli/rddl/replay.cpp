// rddl replay: steps that a file or another program asks for, line by line.
#include "commands.hpp"
#include "interrupt.hpp"
#include "line_stream.hpp"
#include "options.hpp"
#include "replay_session.hpp"
#include "support/program.hpp"
#include "violations.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace rddlc::cli {

namespace {

struct ReplayCommandOptions {
    ProblemArguments problem;
    LoadOptions load;
    ReplayOptions session;
    std::string input = "-";
    std::string output = "-";
};

// Tells of violated preconditions on stderr: the first with all circumstances, all as a number.
class ViolationLog {
  public:
    ViolationLog(const ProblemFiles& files, const LoadOptions& load, Preconditions preconditions)
        : explainer_(files, load), preconditions_(preconditions) {}

    // The message in one line.
    std::string add(const Violation& violation) {
        const ViolationText text = explainer_.precondition(violation);
        const char* const severity = preconditions_ == Preconditions::Error ? "error" : "warning";
        if (count_++ == 0) tell(text.diagnostic(severity, ""));
        return text.line();
    }

    void print_total() const {
        if (count_ == 0) return;
        tell("rddl: {} action{} violated a precondition: {}\n", count_, count_ == 1 ? "" : "s",
             fate_of_illegal_actions(preconditions_));
    }

  private:
    ViolationExplainer explainer_;
    Preconditions preconditions_;
    std::size_t count_ = 0;
};

ExitStatus replay(const ReplayCommandOptions& options) {
    const LoadedProblem problem = load_problem(options.problem.files(), options.load);
    UsedFiles used = problem.used;
    LineReader input(options.input, used);
    LineWriter output(options.output, used);
    ViolationLog log(problem.files, options.load, options.session.preconditions);
    ReplayOptions session_options = options.session;
    session_options.explain = [&](const Violation& violation) {
        return log.add(violation);
    };
    ReplaySession session(*problem.simulator, session_options);
    while (const auto line = input.next()) output.write(session.answer(*line));
    output.finish();
    log.print_total();
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
    add_course_options(*app, options->session.seed,
                       "Seed of all random numbers (the input's if it is a trace, else 0)",
                       options->session.horizon,
                       "Steps an episode; 0: no horizon (the trace's or the instance's)");
    add_preconditions_option(*app, options->session.preconditions);
    add_engine_options(*app, options->load);
    return {app, [options] {
                return replay(*options);
            }};
}

}  // namespace rddlc::cli
