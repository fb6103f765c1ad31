// Running another program, without a shell in between.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace rddlc {

// The largest output of a process that is kept, in bytes, not counting the end of the last read.
inline constexpr std::size_t most_process_output = std::size_t{1} << 24;

struct ProcessResult {
    int status;          // its exit status; 128 + the signal that ended it
    std::string output;  // what it wrote on its standard output and error, cut off there
    bool timed_out = false;

    bool was_killed() const { return status >= 128; }
};

// Looks command[0] up in PATH and waits for it, but no longer than `limit`; if we are killed, it
// is, with all that it started. It also ends when `stop` is requested: then, and only where it can
// be requested, Ctrl-C leaves it alone. It reads nothing. `environment` holds variables,
// "LC_ALL=C", in place of ours. Nothing, with errno set, if it does not start.
std::optional<ProcessResult> run_process(const std::vector<std::string>& command,
                                         const std::vector<std::string>& environment = {},
                                         std::optional<std::chrono::seconds> limit = {},
                                         const std::stop_token& stop = {});

}  // namespace rddlc
