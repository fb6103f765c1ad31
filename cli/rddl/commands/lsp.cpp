// rddl lsp: the language server for editors.
#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "lsp/server.hpp"
#include "support/program.hpp"

#include <unistd.h>

#include <csignal>
#include <memory>

namespace rddlc::cli {

Command lsp_command() {
    const auto options = std::make_shared<lsp::ServerOptions>();
    Command command;
    command.name = "lsp";
    command.summary = "Serve an editor: diagnostics, completion, names";
    command.details =
        "Editors start it; it speaks the Language Server Protocol on stdin and stdout. "
        "editors/README.md\n"
        "says how Neovim, Emacs, Helix and Visual Studio Code are set up.\n\n"
        "Example:\n"
        "  rddl lsp --std rddlc";
    add_standard_option(command, options->standard);
    add_flag(command, "--stdio",
             "Speak on stdin and stdout: the only way, which some editors ask for",
             [](const std::string&) {});
    command.run = [options] {
        if (is_terminal(STDIN_FILENO))
            tell("rddl lsp waits for the messages of an editor; Ctrl-C ends it\n");
        std::signal(SIGPIPE, SIG_IGN);  // an editor that is gone is noticed when writing
        return lsp::serve(STDIN_FILENO, STDOUT_FILENO, *options);
    };
    return command;
}

}  // namespace rddlc::cli
