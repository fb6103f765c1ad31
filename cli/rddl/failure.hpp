// How a command gives up: thrown anywhere below main, which prints it and picks the exit status.
#pragma once

#include <stdexcept>
#include <string>

namespace rddlc::cli {

enum ExitStatus {
    success = 0,
    diagnosed = 1,
    usage_error = 2,
    internal_error = 70,
    interrupted = 130
};

struct Failure : std::runtime_error {
    explicit Failure(std::string message, std::string advice = {}, ExitStatus exit = diagnosed)
        : std::runtime_error(std::move(message)), hint(std::move(advice)), status(exit) {}

    std::string hint;  // what to try, a whole clause; may be empty
    ExitStatus status;
};

// The diagnostics are printed already; nothing is left to say.
struct Diagnosed {};

}  // namespace rddlc::cli
