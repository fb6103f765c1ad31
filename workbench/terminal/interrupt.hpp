// Ctrl-C as a question that long work asks itself.
#pragma once

#include "support/failure.hpp"

#include <string_view>

namespace rddlc::workbench {

// From now on the first Ctrl-C (or SIGTERM, or the SIGHUP of a terminal that is closed) only makes
// `is_interrupted` true; another one, a little later, ends the process at once. Signals that this
// process inherits as ignored, as from nohup, stay ignored.
void catch_interrupts();

bool is_interrupted();

// The exit status after an interrupt: 128 and the number of the signal, 130 for Ctrl-C.
ExitStatus interrupted_status();

// Throws a Failure "interrupted while compiling". While something is compiled Ctrl-C also reaches
// the compiler, which then ends as if it had failed.
void give_up_if_interrupted(std::string_view doing = "compiling");

}  // namespace rddlc::workbench
