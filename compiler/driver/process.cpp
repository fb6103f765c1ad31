#include "driver/process.hpp"

#include "driver/watched_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <string_view>

namespace rddlc {
namespace {

using Clock = std::chrono::steady_clock;

// Waits until there is something to read, or the output ends. False when the time is over before.
bool wait_for_output(int descriptor, std::optional<Clock::time_point> end) {
    while (end) {
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(*end - Clock::now()).count();
        if (left <= 0) return false;
        pollfd output{descriptor, POLLIN, 0};
        const int most = static_cast<int>(std::min<std::int64_t>(left, 1'000'000));
        if (::poll(&output, 1, most) > 0) return true;
    }
    return true;
}

// False when the time was over before the output was.
bool read_all(int descriptor, std::optional<Clock::time_point> end, std::string& text) {
    std::array<char, 4096> buffer;
    while (wait_for_output(descriptor, end)) {
        const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
        if (count > 0 && text.size() < most_process_output)
            text.append(buffer.data(), static_cast<std::size_t>(count));
        if (count == 0 || (count < 0 && errno != EINTR)) return true;
    }
    return false;
}

int wait_for(pid_t process) {
    int status = 0;
    while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string_view name_of(std::string_view variable) {
    return variable.substr(0, variable.find('='));
}

// Our environment, except for the variables that are replaced.
std::vector<std::string> environment_with(std::vector<std::string> variables) {
    const std::vector<std::string> given = variables;
    for (char** ours = environ; *ours; ++ours)
        if (std::ranges::find(given, name_of(*ours), name_of) == given.end())
            variables.emplace_back(*ours);
    return variables;
}

}  // namespace

std::optional<ProcessResult> run_process(const std::vector<std::string>& command,
                                         const std::vector<std::string>& environment,
                                         std::optional<std::chrono::seconds> limit) {
    std::array<int, 2> ends;  // to read from, to write to
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return std::nullopt;

    const pid_t process = start_watched(command, environment_with(environment), ends[1]);
    const int error = process < 0 ? errno : 0;
    ::close(ends[1]);
    std::optional<ProcessResult> result;
    if (process > 0) {
        result.emplace();
        const auto end = limit ? std::optional(Clock::now() + *limit) : std::nullopt;
        result->timed_out = !read_all(ends[0], end, result->output);
        if (result->timed_out) ::kill(process, SIGTERM);
        result->status = wait_for(process);
    }
    ::close(ends[0]);
    errno = error;
    return result;
}

}  // namespace rddlc
