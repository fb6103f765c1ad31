// `rddl`: RDDL problems at work. Each subcommand has a file of its own.
#include "commands.hpp"
#include "driver/version.hpp"
#include "interrupt.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <exception>

namespace rddlc::cli {

namespace {

constexpr const char* overview =
    "RDDL problems at work: look at them, run them, measure them.\n\n"
    "A problem P is two files, DOMAIN INSTANCE, or the NAME and INSTANCE of a problem of\n"
    "rddlrepository, found at $RDDL_REPOSITORY or as the installed Python package.";

constexpr const char* examples =
    "Examples:\n"
    "  rddl list traffic\n"
    "  rddl info MountainCar_ippc2023 1\n"
    "  rddl check domain.rddl instance.rddl\n"
    "  rddl run domain.rddl instance.rddl --episodes 1000 --seed 7\n\n"
    "'rddl COMMAND --help' tells more about a command.";

// Help and version end with 0, everything else that stops the parsing is a usage error.
ExitStatus report(const CLI::App& program, const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
        program.exit(error);
        return success;
    }
    fmt::print(stderr, "rddl: error: {}\n", error.what());
    const auto chosen = program.get_subcommands();
    fmt::print(stderr, "'rddl{} --help' shows the usage\n",
               chosen.empty() ? "" : " " + chosen.front()->get_name());
    return usage_error;
}

ExitStatus run(int argc, char** argv) {
    CLI::App program(overview, "rddl");
    program.footer(examples);
    program.set_version_flag("--version", fmt::format("rddl {}", version));
    program.require_subcommand(1);
    program.get_formatter()->column_width(32);

    const std::array commands{add_list_command(program),   add_info_command(program),
                              add_check_command(program),  add_run_command(program),
                              add_replay_command(program), add_bench_command(program)};
    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return report(program, error);
    }
    catch_interrupts();
    for (const Command& command : commands)
        if (command.app->parsed()) return command.run();
    return usage_error;
}

ExitStatus run_and_report(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const Diagnosed&) {
        return diagnosed;
    } catch (const Failure& failure) {
        fmt::print(stderr, "rddl: error: {}\n", failure.what());
        if (!failure.hint.empty()) fmt::print(stderr, "  {}\n", failure.hint);
        return failure.status;
    } catch (const std::exception& error) {
        fmt::print(stderr,
                   "rddl: internal error: {}\n"
                   "This is a mistake in rddl, not in your problem: please report it with the "
                   "command and the files.\n",
                   error.what());
        return internal_error;
    }
}

}  // namespace

}  // namespace rddlc::cli

int main(int argc, char** argv) {
    return rddlc::cli::run_and_report(argc, argv);
}
