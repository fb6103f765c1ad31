#include "engines/background_build.hpp"

#include "support/failure.hpp"

#include <unistd.h>

#include <exception>
#include <future>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

namespace rddlc::workbench {

BackgroundBuild::BackgroundBuild(Build build, Report report)
    : build_(std::move(build)), report_(std::move(report)) {
    const std::scoped_lock lock(mutex_);
    start();
}

BackgroundBuild::~BackgroundBuild() {
    stop();
}

void BackgroundBuild::start() {
    process_ = ::getpid();
    stop_ = std::stop_source();
    try {
        std::packaged_task<void()> task([this, stop = stop_.get_token()] { run(stop); });
        ended_ = task.get_future();
        std::thread(std::move(task)).detach();
    } catch (const std::system_error&) {
        settled_ = true;  // the system starts no more threads
    }
}

void BackgroundBuild::run(const std::stop_token& stop) {
    const auto fail = [&](const std::string& why) {
        if (!stop.stop_requested()) report_(why);
    };
    try {
        simulator_ = build_(stop);
        ready_.store(simulator_.get(), std::memory_order_release);
    } catch (const std::exception& error) {
        fail(error.what());
    } catch (const Diagnosed&) {
        fail("the C++ compiler has refused it");
    }
    settled_.store(true, std::memory_order_release);
}

void BackgroundBuild::revive() {
    if (is_settled() || process_ == ::getpid()) return;
    const std::scoped_lock lock(mutex_);
    start();
}

void BackgroundBuild::stop() {
    const std::scoped_lock lock(mutex_);
    stop_.request_stop();
    if (!is_settled() && process_ == ::getpid()) ended_.wait();
    settled_ = true;
}

}  // namespace rddlc::workbench
