#include "terminal/interrupt.hpp"

#include "support/failure.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <ctime>

namespace rddlc::cli {

namespace {

// A signal handler can reach nothing but globals.
std::atomic<bool> interrupt_seen = false;
std::atomic<std::time_t> first_interrupt = 0;
static_assert(std::atomic<bool>::is_always_lock_free);
static_assert(std::atomic<std::time_t>::is_always_lock_free);

// One Ctrl-C may arrive several times, by way of the process group and of a parent.
constexpr std::time_t same_interrupt = 1;  // seconds

void on_interrupt(int) {
    const std::time_t now = std::time(nullptr);
    if (!interrupt_seen.exchange(true))
        first_interrupt = now;
    else if (now - first_interrupt > same_interrupt)
        _exit(interrupted);
}

}  // namespace

void catch_interrupts() {
    struct sigaction action {};
    action.sa_handler = on_interrupt;
    // No SA_RESTART: a blocked read returns, so that its caller sees the interrupt.
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

bool is_interrupted() {
    return interrupt_seen;
}

void give_up_if_interrupted() {
    if (is_interrupted()) throw Failure("interrupted while compiling", "", interrupted);
}

}  // namespace rddlc::cli
