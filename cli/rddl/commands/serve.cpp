// rddl serve: an environment for clients of IPPC 2011 to 2018.
#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "formats/number_text.hpp"
#include "protocol/server.hpp"
#include "solvers/evaluation/summary.hpp"
#include "support/files.hpp"
#include "support/program.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/progress.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <memory>

namespace rddlc::cli {

namespace {

struct ServeOptions {
    ProblemArguments problem;
    LoadOptions load;
    ServerOptions server;
};

// Domain and instance, one after the other, as clients parse them.
std::string task_of(const ProblemFiles& files) {
    std::string text;
    for (const std::filesystem::path& file : files.inputs())
        text += rddlc::read_file(file, largest_text) + "\n\n";
    return text;
}

void print_session(const ServerSession& session) {
    const solvers::Estimate returns = solvers::estimate_of(session.returns());
    const auto rounds = session.returns().size();
    print("{}: {}, {} round{}, {} turns, {}\n", session.client(),
          rounds == 0
              ? "no return"
              : fmt::format("return {} ± {:.3g}", number_text(returns.mean), returns.half_width),
          rounds, rounds == 1 ? "" : "s", session.turns(), duration_text(session.seconds()));
    std::fflush(stdout);
}

ExitStatus serve(ServeOptions options) {
    const LoadedProblem problem = load_problem(options.problem.files(), options.load);
    const ServedProblem served(*problem.simulator, task_of(problem.files));
    options.server.ended = print_session;
    options.server.tell = [](const std::string& sentence) {
        tell("rddl: {}\n", sentence);
    };
    ProtocolServer server(served, options.server);
    print("{} ({}) at {}:{}\n", problem.simulator->problem->instance,
          problem.simulator->problem->domain, options.server.host, server.port());
    std::fflush(stdout);
    server.run(is_interrupted);
    return is_interrupted() ? interrupted_status() : success;
}

}  // namespace

Command serve_command() {
    const auto options = std::make_shared<ServeOptions>();
    Command command;
    command.name = "serve";
    command.summary = "Be the environment of clients of IPPC 2011 to 2018, such as PROST";
    command.details =
        "The protocol is rddlsim's, at its port. A line is printed for each session.\n\n"
        "Examples:\n"
        "  rddl serve Elevators_MDP_ippc2011 1 --rounds 30 --time 1080\n"
        "  rddl serve domain.rddl instance.rddl --port 0 --sessions 1";
    add_problem_arguments(command, options->problem);
    add_number_option<int>(command, "--port", "PORT", "Port; 0: one that is free (2323)",
                           options->server.port, 0, 65535);
    add_text_option(command, "--host", "ADDRESS",
                    "Address to listen at; any program that reaches it can play (127.0.0.1)",
                    options->server.host);
    add_number_option<std::int64_t>(command, "--rounds", "N", "Rounds of a session (30)",
                                    options->server.session.rounds, 1, 1'000'000);
    add_number_option<double>(command, "--time", "SECONDS", "Time of a session (1080)",
                              options->server.session.seconds, 0.001, 1e9);
    add_seed_option(command, options->server.session.seed,
                    "Seed of all random numbers, the same for each session (0)");
    add_number_option<std::int64_t>(command, "--sessions", "N",
                                    "End after so many sessions; 0: never (0)",
                                    options->server.sessions, 0, 1'000'000'000);
    add_number_option<double>(command, "--patience", "SECONDS",
                              "Time for a client to begin, to end a message or to read one (60)",
                              options->server.patience, 0.001, 1e9);
    add_engine_options(command, options->load);
    command.run = [options] {
        return serve(*options);
    };
    return command;
}

}  // namespace rddlc::cli
