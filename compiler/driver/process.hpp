// Running another program, without a shell in between.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace rddlc {

struct ProcessResult {
    int status;          // its exit status; 128 + the signal that ended it
    std::string output;  // what it wrote on its standard output and error
};

// Looks command[0] up in PATH and waits for it. `environment` holds variables, "LC_ALL=C", in place
// of ours. Nothing, with errno set, if it does not start.
std::optional<ProcessResult> run_process(const std::vector<std::string>& command,
                                         const std::vector<std::string>& environment = {});

}  // namespace rddlc
