// Running another program.
#pragma once

#include <string>
#include <vector>

namespace rddlc::cli {

struct ProcessResult {
    int status = 127;    // exit status; 127 if it could not be started, 128 + signal if killed
    std::string output;  // of both streams
};

// Without a shell: the words are the arguments. Waits for the end.
ProcessResult run_process(const std::vector<std::string>& words);

}  // namespace rddlc::cli
