#include "interrupt.hpp"

#include <atomic>
#include <csignal>

namespace rddlc::cli {

namespace {

// A signal handler can reach nothing but a global.
std::atomic<bool> interrupt_seen = false;
static_assert(std::atomic<bool>::is_always_lock_free);

}  // namespace

void catch_interrupts() {
    struct sigaction action {};
    action.sa_handler = [](int) {
        interrupt_seen = true;
    };
    // No SA_RESTART: a blocked read returns, so that its caller sees the interrupt.
    action.sa_flags = SA_RESETHAND;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

bool is_interrupted() {
    return interrupt_seen;
}

}  // namespace rddlc::cli
