// rddl replay: steps that a file or another program asks for, line by line.
#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "formats/line_stream.hpp"
#include "formats/trace.hpp"
#include "rollouts/replay_session.hpp"
#include "rollouts/violations.hpp"
#include "support/program.hpp"
#include "terminal/interrupt.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::cli {

namespace {

struct ReplayCommandOptions {
    ProblemArguments problem;
    LoadOptions load;
    ReplayOptions session;
    std::string input = "-";
    std::string output = "-";
};

// Reports violated preconditions on stderr: the first with all circumstances, all as a number.
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

// The first trace whose files had another text reports it, for all.
class ChangedFiles {
  public:
    explicit ChangedFiles(std::vector<std::filesystem::path> files) : files_(std::move(files)) {}

    void see_header(const nlohmann::json& header) {
        if (is_told_) return;
        for (const auto& file : changed_files(header, files_)) {
            tell(
                "rddl: warning: '{}' is not the file that the trace was made with: its steps may "
                "come out differently\n",
                file.string());
            is_told_ = true;
        }
    }

  private:
    std::vector<std::filesystem::path> files_;
    bool is_told_ = false;
};

// Nothing at the end of the input.
std::optional<std::string> next_answer(LineReader& input, ReplaySession& session) {
    try {
        const auto line = input.next();
        if (!line) return std::nullopt;
        return session.answer(*line);
    } catch (const LongLine& line) {
        return session.refuse(line.what());
    }
}

ExitStatus replay(const ReplayCommandOptions& options) {
    const LoadedProblem problem = load_problem(options.problem.files(), options.load);
    UsedFiles used = problem.used;
    LineReader input(options.input, used, longest_line(TraceFormat(*problem.simulator->problem)));
    LineWriter output(options.output, used);
    ViolationLog log(problem.files, options.load, options.session.preconditions);
    ReplayOptions session_options = options.session;
    session_options.explain = [&](const Violation& violation) {
        return log.add(violation);
    };
    ChangedFiles changed(problem.files.inputs());
    session_options.see_header = [&](const nlohmann::json& header) {
        changed.see_header(header);
    };
    ReplaySession session(*problem.simulator, session_options);
    while (const auto answer = next_answer(input, session)) output.write(*answer);
    output.finish();
    log.print_total();
    return is_interrupted() ? interrupted_status() : success;
}

}  // namespace

Command replay_command() {
    const auto options = std::make_shared<ReplayCommandOptions>();
    Command command;
    command.name = "replay";
    command.summary = "Step the simulator from JSON input";
    command.details =
        "An input line is {\"action\": {...}, \"state\": {...}}, both optional; the state (or a\n"
        "part of it) is set before the step. The answer is {\"state\": {...}, \"observation\":\n"
        "{...} or null, \"reward\": r, \"terminated\": b, \"truncated\": b}, or {\"error\": "
        "\"...\"}\n"
        "for a line that is refused. docs/traces.md lists all members. A trace of 'rddl run' is\n"
        "also an input. In a pipe every answer comes at once, so a program can drive this.\n\n"
        "Examples:\n"
        "  rddl replay domain.rddl instance.rddl --input actions.jsonl --output trace.jsonl\n"
        "  echo '{\"action\": {\"throttle\": 1.0}}' | rddl replay domain.rddl instance.rddl\n"
        "  echo '{\"repeat\": 1000}' | rddl replay SysAdmin_MDP_ippc2011 1 --seed 3";
    add_problem_arguments(command, options->problem);
    add_text_option(command, "--input", "FILE", "Lines of JSON; - (default) is standard input",
                    options->input);
    add_text_option(command, "--output", "FILE", "Answers; - (default) is standard output",
                    options->output);
    add_seed_option(command, options->session.seed,
                    "Seed of all random numbers (the input's if it is a trace, else 0)");
    add_horizon_option(command, options->session.horizon,
                       "Steps an episode; 0: no horizon (the trace's or the instance's)");
    add_preconditions_option(command, options->session.preconditions);
    add_engine_options(command, options->load);
    command.run = [options] {
        return replay(*options);
    };
    return command;
}

}  // namespace rddlc::cli
