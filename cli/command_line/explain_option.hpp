// --explain CODE, which both programs know.
#pragma once

#include "command_line/command_line.hpp"

#include <string>

namespace rddlc::cli {

// Sets `explanation` to what there is to print; it outlives the command.
void add_explain_option(Command& command, std::string& explanation);

}  // namespace rddlc::cli
