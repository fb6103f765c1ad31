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

// When to stop waiting for a process.
struct Patience {
    std::optional<Clock::time_point> end;
    const std::stop_token& stop;

    bool is_endless() const { return !end && !stop.stop_possible(); }
    // Milliseconds until it has to be asked again; not positive when it is over.
    std::int64_t left() const {
        constexpr std::int64_t between_looks = 20, longest = 1'000'000;
        if (stop.stop_requested()) return 0;
        const std::int64_t most = stop.stop_possible() ? between_looks : longest;
        if (!end) return most;
        const auto time =
            std::chrono::duration_cast<std::chrono::milliseconds>(*end - Clock::now());
        return std::min<std::int64_t>(time.count(), most);
    }
};

// Waits until there is something to read, or the output ends. False when the patience is over
// before.
bool wait_for_output(int descriptor, const Patience& patience) {
    while (!patience.is_endless()) {
        const std::int64_t left = patience.left();
        if (left <= 0) return false;
        pollfd output{descriptor, POLLIN, 0};
        if (::poll(&output, 1, static_cast<int>(left)) > 0) return true;
    }
    return true;
}

// False when the patience was over before the output was.
bool read_all(int descriptor, const Patience& patience, std::string& text) {
    std::array<char, 4096> buffer;
    while (wait_for_output(descriptor, patience)) {
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
                                         std::optional<std::chrono::seconds> limit,
                                         const std::stop_token& stop) {
    std::array<int, 2> ends;  // to read from, to write to
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return std::nullopt;

    const auto interrupts = stop.stop_possible() ? Interrupts::Ignored : Interrupts::End;
    const pid_t process =
        start_watched(command, environment_with(environment), ends[1], interrupts);
    const int error = process < 0 ? errno : 0;
    ::close(ends[1]);
    std::optional<ProcessResult> result;
    if (process > 0) {
        result.emplace();
        const auto end = limit ? std::optional(Clock::now() + *limit) : std::nullopt;
        const bool ended = read_all(ends[0], {end, stop}, result->output);
        if (!ended) ::kill(process, SIGTERM);
        result->timed_out = !ended && !stop.stop_requested();
        result->status = wait_for(process);
    }
    ::close(ends[0]);
    errno = error;
    return result;
}

}  // namespace rddlc
