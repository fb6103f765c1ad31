// rddl studio: a page on which problems are written and tried.
#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "studio/desktop_browser.hpp"
#include "studio/server.hpp"
#include "support/program.hpp"
#include "terminal/interrupt.hpp"

#include <unistd.h>

#include <cstdio>
#include <memory>
#include <optional>
#include <string>

namespace rddlc::cli {

namespace {

struct StudioArguments {
    ProblemArguments problem;
    LoadOptions load;
    studio::ServerOptions server;
    bool shows_browser = true;
};

studio::OpenedProblem opened_problem(const ProblemArguments& arguments) {
    if (arguments.first.empty()) {
        studio::OpenedProblem problem = studio::first_problem();
        problem.files = arguments.with_options(problem.files);
        return problem;
    }
    studio::OpenedProblem problem = studio::open_problem(arguments.files());
    problem.can_save = is_path(arguments.first);  // else it is of rddlrepository
    return problem;
}

// Whether all requests and jobs have ended.
bool serve_with_browser(studio::StudioServer& server, bool shows_browser) {
    std::optional<studio::DesktopBrowser> browser;
    if (shows_browser) browser.emplace(server.address());
    return server.run([&browser] {
        if (browser) browser->forget_ended();
        return is_interrupted();
    });
}

ExitStatus serve_studio(const StudioArguments& arguments) {
    studio::StudioServer server(
        std::make_shared<studio::Studio>(opened_problem(arguments.problem),
                                         studio::StudioOptions{arguments.load}),
        arguments.server);
    print("{}\n", server.address());
    std::fflush(stdout);
    tell("rddl studio: open this address in a browser of this machine; Ctrl-C ends it\n");
    const bool ended = serve_with_browser(server, arguments.shows_browser);
    // A compilation that takes minutes cannot be stopped, and holds nothing that would be lost.
    if (!ended) _exit(interrupted_status());
    return interrupted_status();
}

}  // namespace

Command studio_command() {
    const auto options = std::make_shared<StudioArguments>();
    Command command;
    command.name = "studio";
    command.summary = "Write and try a problem on a page in the browser";
    command.details =
        "Prints the address of the page, which only this machine reaches, with a secret of this "
        "run in it.\n"
        "Without a problem it begins with a small one. docs/studio.md describes the page.\n\n"
        "Examples:\n"
        "  rddl studio\n"
        "  rddl studio domain.rddl instance.rddl\n"
        "  rddl studio MountainCar_ippc2023 1 --no-browser --port 8000";
    add_problem_arguments(command, options->problem, false);
    add_number_option<int>(command, "--port", "PORT",
                           "Port; 0: one that is free (7334, or one that is free if that is taken)",
                           options->server.port, 0, 65535);
    add_flag(command, "--no-browser", "Do not open the page in the browser of the desktop",
             [options](const std::string&) { options->shows_browser = false; });
    add_engine_options(command, options->load);
    command.run = [options] {
        return serve_studio(*options);
    };
    return command;
}

}  // namespace rddlc::cli
