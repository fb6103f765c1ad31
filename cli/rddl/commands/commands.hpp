// The subcommands of `rddl`, one file each.
#pragma once

#include "command_line/command_line.hpp"

// The parts of commands are in workbench/.
namespace rddlc::workbench {}

namespace rddlc::cli {

using namespace workbench;

Command list_command();
Command info_command();
Command check_command();
Command fmt_command();
Command lsp_command();
Command studio_command();
Command run_command();
Command evaluate_command();
Command compare_command();
Command train_command();
Command export_command();
Command plot_command();
Command replay_command();
Command solve_command();
Command serve_command();
Command play_command();
Command render_command();
Command bench_command();
Command verify_command();

}  // namespace rddlc::cli
