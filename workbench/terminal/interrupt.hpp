// Ctrl-C as a question that long work asks itself.
#pragma once

#include "support/failure.hpp"

#include <string_view>

namespace rddlc::workbench {

// From now on the first Ctrl-C (or SIGTERM, or the SIGHUP of a terminal that is closed) only makes
// `is_interrupted` true; one more, a little later, ends the process at once. Signals that whoever
// started this process has it ignore, as nohup does, stay ignored.
void catch_interrupts();

bool is_interrupted();

// With which to end then: 128 and the number of the signal, 130 for Ctrl-C.
ExitStatus interrupted_status();

// Throws a Failure "interrupted while compiling". While something is compiled Ctrl-C reaches the
// compiler, too, which then ends as if it had failed.
void give_up_if_interrupted(std::string_view doing = "compiling");

}  // namespace rddlc::workbench
