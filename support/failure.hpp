// Exceptions that end a run of either program before its work is done. The type of an exception
// says whose fault it is; only support/program.hpp turns it into a message and an exit status.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <string_view>

namespace rddlc {

// 70 is for mistakes of our own alone.
enum ExitStatus : int {
    success = 0,
    diagnosed = 1,
    usage_error = 2,
    internal_error = 70
    // 128 and the number of the signal that ended it, as shells count
};

// The user's command, files or machine do not allow it: no such file, a full disk, no memory.
struct Failure : std::runtime_error {
    explicit Failure(std::string message, std::string advice = {}, ExitStatus exit = diagnosed)
        : std::runtime_error(std::move(message)), hint(std::move(advice)), status(exit) {}

    std::string hint;  // what to try, a whole clause; may be empty
    ExitStatus status;
};

// A mistake of our own: what was met, and where it was noticed. Programs end with status 70. The
// place is asked of the compiler, since clang++ 14 has no std::source_location.
[[noreturn]] inline void own_mistake(std::string_view what, const char* file = __builtin_FILE(),
                                     int line = __builtin_LINE(),
                                     const char* function = __builtin_FUNCTION()) {
    throw std::logic_error(fmt::format("{} ({}:{}, {})", what, file, line, function));
}

// The diagnostics are printed already; nothing is left to say.
struct Diagnosed {};

}  // namespace rddlc
