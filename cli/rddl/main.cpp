// `rddl`: RDDL problems at work. Each subcommand has a file of its own in commands/.
#include "command_line/explain_option.hpp"
#include "commands/commands.hpp"
#include "driver/version.hpp"
#include "support/program.hpp"
#include "terminal/interrupt.hpp"

#include <fmt/format.h>

#include <memory>
#include <string>

namespace rddlc::cli {

namespace {

Command rddl_command() {
    Command program;
    program.name = "rddl";
    program.summary =
        "Inspect, run and measure RDDL problems.\n\n"
        "A problem is two files, DOMAIN INSTANCE; one file that holds both; a folder of a "
        "domain.rddl\n"
        "and its instances, with the number of one unless there is only one; or the NAME and "
        "INSTANCE\n"
        "of a problem of rddlrepository, found at $RDDL_REPOSITORY or as the installed Python "
        "package.";
    program.details =
        "Examples:\n"
        "  rddl list traffic\n"
        "  rddl info MountainCar_ippc2023 1\n"
        "  rddl check domain.rddl instance.rddl\n"
        "  rddl fmt domain.rddl instance.rddl\n"
        "  rddl run domain.rddl instance.rddl --episodes 1000 --seed 7\n"
        "  rddl verify domain.rddl instance.rddl\n"
        "  rddl --explain E0203\n\n"
        "'rddl help COMMAND' explains a command.";
    const auto explanation = std::make_shared<std::string>();
    add_explain_option(program, *explanation);
    program.run = [explanation] {
        print("{}", *explanation);
        return success;
    };
    program.commands = {list_command(),     info_command(),    check_command(), fmt_command(),
                        lsp_command(),      studio_command(),  run_command(),   render_command(),
                        evaluate_command(), compare_command(), train_command(), export_command(),
                        plot_command(),     replay_command(),  solve_command(), serve_command(),
                        play_command(),     bench_command(),   verify_command()};
    return program;
}

}  // namespace

}  // namespace rddlc::cli

int main(int argc, char** argv) {
    using namespace rddlc;
    return run_program("rddl", version, [&] {
        workbench::catch_interrupts();
        return cli::run_command_line(cli::rddl_command(), version, argc, argv);
    });
}
