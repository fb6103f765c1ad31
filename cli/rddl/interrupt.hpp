// Ctrl-C as a question that long work asks itself.
#pragma once

namespace rddlc::cli {

// From now on the first Ctrl-C (or SIGTERM) only makes `interrupted` true; the second one kills.
void catch_interrupts();

bool is_interrupted();

}  // namespace rddlc::cli
