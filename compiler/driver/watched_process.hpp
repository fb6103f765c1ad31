// A program that does not outlive us.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace rddlc {

// Whether signals of the terminal (Ctrl-C, its end) also end the program, or only SIGTERM.
enum class Interrupts { End, Ignored };

// Starts command[0], looked up in PATH, with these variables and no standard input; its output and
// errors go to the descriptor `output`. It and all that it starts are a process group of their own,
// beside which stands a small process of ours, which is given back: it ends with the status of the
// program. Where it gets SIGTERM, or a signal of the terminal that is not ignored, or the thread
// that called this ends, be it by SIGKILL (Linux), it ends that group. So the calling thread must
// wait for it.
//
// -1, with errno set, if the program does not start.
pid_t start_watched(const std::vector<std::string>& command,
                    const std::vector<std::string>& environment, int output,
                    Interrupts interrupts = Interrupts::End);

}  // namespace rddlc
