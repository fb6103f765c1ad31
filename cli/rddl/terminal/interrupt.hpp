// Ctrl-C as a question that long work asks itself.
#pragma once

namespace rddlc::cli {

// From now on the first Ctrl-C (or SIGTERM) only makes `is_interrupted` true; one more,
// a little later, ends the process at once.
void catch_interrupts();

bool is_interrupted();

// While something is compiled: throws a Failure. Ctrl-C reaches the compiler, too, which then ends
// as if it had failed.
void give_up_if_interrupted();

}  // namespace rddlc::cli
