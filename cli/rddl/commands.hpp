// The subcommands of `rddl`, one file each.
#pragma once

#include "support/failure.hpp"

#include <CLI/CLI.hpp>

#include <functional>

namespace rddlc::cli {

struct Command {
    CLI::App* app;                    // knows whether it was asked for
    std::function<ExitStatus()> run;  // after parsing
};

Command add_list_command(CLI::App& program);
Command add_info_command(CLI::App& program);
Command add_check_command(CLI::App& program);
Command add_fmt_command(CLI::App& program);
Command add_run_command(CLI::App& program);
Command add_replay_command(CLI::App& program);
Command add_bench_command(CLI::App& program);
Command add_verify_command(CLI::App& program);

}  // namespace rddlc::cli
