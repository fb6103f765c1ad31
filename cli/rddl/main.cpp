// `rddl`: RDDL problems at work. Each subcommand has a file of its own.
#include "commands.hpp"
#include "driver/version.hpp"
#include "interrupt.hpp"
#include "support/diagnostic.hpp"
#include "support/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string>
#include <vector>

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
    "  rddl fmt domain.rddl instance.rddl\n"
    "  rddl run domain.rddl instance.rddl --episodes 1000 --seed 7\n"
    "  rddl verify domain.rddl instance.rddl\n\n"
    "'rddl COMMAND --help' tells more about a command.";

std::string did_you_mean_text(const std::string& name, const std::vector<std::string>& known) {
    const auto near = did_you_mean(name, known);
    return near ? fmt::format("; did you mean '{}'?", *near) : "";
}

std::vector<std::string> names_of(const std::vector<const CLI::App*>& commands) {
    std::vector<std::string> names;
    for (const CLI::App* command : commands) names.push_back(command->get_name());
    return names;
}

std::vector<std::string> option_names(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

// What is wrong with the command line, in words that help.
std::string usage_message(const CLI::App& program, const CLI::App* command,
                          const CLI::ParseError& error) {
    const std::vector<std::string> left = program.remaining(true);
    const auto is_option = [](const std::string& word) {
        return word.starts_with('-');
    };
    if (!command && !left.empty() && !is_option(left.front()))
        return fmt::format(
            "no command is called '{}'{}", left.front(),
            did_you_mean_text(left.front(), names_of(program.get_subcommands(nullptr))));
    const auto unknown = std::find_if(left.begin(), left.end(), is_option);
    if (unknown != left.end()) {
        const std::string name = unknown->substr(0, unknown->find('='));
        return fmt::format("unknown option '{}'{}", name,
                           did_you_mean_text(name, option_names(command ? *command : program)));
    }
    if (!left.empty()) return fmt::format("too many arguments: '{}'", left.front());
    if (!command) return "name a command, such as 'rddl run'";
    return error.what();
}

// Help and version end with 0, everything else that stops the parsing is a usage error.
ExitStatus report_usage(const CLI::App& program, const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
        std::ostringstream text;
        program.exit(error, text, text);
        fmt::print("{}", text.str());
        return success;
    }
    const auto chosen = program.get_subcommands();
    const CLI::App* const command = chosen.empty() ? nullptr : chosen.front();
    tell("rddl: error: {}\n'rddl{} --help' shows the usage\n",
         usage_message(program, command, error), command ? " " + command->get_name() : "");
    return usage_error;
}

ExitStatus run(int argc, char** argv) {
    CLI::App program(overview, "rddl");
    program.footer(examples);
    program.set_version_flag("--version", fmt::format("rddl {}", version));
    program.require_subcommand(1);
    program.get_formatter()->column_width(32);

    const std::array commands{add_list_command(program),  add_info_command(program),
                              add_check_command(program), add_fmt_command(program),
                              add_run_command(program),   add_replay_command(program),
                              add_bench_command(program), add_verify_command(program)};
    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return report_usage(program, error);
    }
    catch_interrupts();
    for (const Command& command : commands)
        if (command.app->parsed()) return command.run();
    return usage_error;
}

}  // namespace

}  // namespace rddlc::cli

int main(int argc, char** argv) {
    using namespace rddlc;
    return run_program("rddl", version, [&] { return cli::run(argc, argv); });
}
