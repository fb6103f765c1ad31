#include "terminal/interrupt.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <ctime>

namespace rddlc::workbench {

namespace {

// A signal handler can reach nothing but globals.
std::atomic<int> signal_seen = 0;
std::atomic<std::time_t> first_interrupt = 0;
static_assert(std::atomic<int>::is_always_lock_free);
static_assert(std::atomic<std::time_t>::is_always_lock_free);

// One Ctrl-C may arrive several times, by way of the process group and of a parent.
constexpr std::time_t same_interrupt = 1;  // seconds

int status_of(int signal) {
    return 128 + signal;
}

void on_interrupt(int signal) {
    const std::time_t now = std::time(nullptr);
    int none = 0;
    if (signal_seen.compare_exchange_strong(none, signal))
        first_interrupt = now;
    else if (now - first_interrupt > same_interrupt)
        _exit(status_of(signal));
}

}  // namespace

void catch_interrupts() {
    struct sigaction action {};
    action.sa_handler = on_interrupt;
    // No SA_RESTART: a blocked read returns, so that its caller sees the interrupt.
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction given {};
        sigaction(signal, nullptr, &given);
        if (given.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
    }
}

bool is_interrupted() {
    return signal_seen != 0;
}

ExitStatus interrupted_status() {
    return static_cast<ExitStatus>(status_of(signal_seen));
}

void give_up_if_interrupted(std::string_view doing) {
    if (is_interrupted())
        throw Failure(fmt::format("interrupted while {}", doing), "", interrupted_status());
}

}  // namespace rddlc::workbench
