#include "cache/builders_turn.hpp"

#include "support/failure.hpp"
#include "support/program.hpp"
#include "terminal/interrupt.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>

namespace rddlc::workbench {

namespace {

using Clock = std::chrono::steady_clock;

int open_place(const std::filesystem::path& place) {
    const int folder = ::open(place.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder >= 0) return folder;
    return ::open(place.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0600);
}

// Whether another process has the lock, as opposed to a file system without locks.
bool is_taken(int descriptor) {
    return ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && (errno == EWOULDBLOCK || errno == EINTR);
}

}  // namespace

BuildersTurn::BuildersTurn(const std::filesystem::path& place, const std::stop_token& stop)
    : descriptor_(open_place(place)) {
    if (descriptor_ < 0 || !is_taken(descriptor_)) return;
    const bool is_background = stop.stop_possible();
    if (!is_background && is_terminal(STDERR_FILENO))
        tell(" (waiting for another process that compiles the same)");
    const auto end = Clock::now() + std::chrono::minutes(is_background ? 20 : 2);
    while (Clock::now() < end && is_taken(descriptor_)) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        if (!is_interrupted() && !stop.stop_requested()) continue;
        ::close(descriptor_);
        give_up_if_stopped(stop);
    }
}

BuildersTurn::~BuildersTurn() {
    if (descriptor_ < 0) return;
    ::flock(descriptor_, LOCK_UN);  // also for processes that were forked meanwhile
    ::close(descriptor_);
}

void give_up_if_stopped(const std::stop_token& stop) {
    give_up_if_interrupted();
    if (stop.stop_requested()) throw Failure("stopped while compiling");
}

}  // namespace rddlc::workbench
