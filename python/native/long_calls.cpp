#include "native/long_calls.hpp"

#include "support/failure.hpp"

#include <unistd.h>

#include <utility>

namespace nb = nanobind;

namespace rddlc::python {

namespace {

constexpr auto between_looks = std::chrono::milliseconds(20);  // at signals
constexpr auto is_much = std::chrono::milliseconds(100);
constexpr auto longest_wait = std::chrono::milliseconds(500);  // for what was asked to end

// A fork lacks the threads of its parent: such a job never ends, and must not be waited for.
void forget(std::future<void> job) {
    static_cast<void>(new std::future<void>(std::move(job)));
}

}  // namespace

LongCalls::~LongCalls() {
    if (!left_.valid()) return;
    if (left_in_ == ::getpid()) {
        const nb::gil_scoped_release released;
        left_.wait();
    } else {
        forget(std::move(left_));
    }
}

bool LongCalls::is_main_thread() {
    const nb::object main = nb::module_::import_("threading").attr("main_thread")();
    return nb::cast<unsigned long>(main.attr("ident")) == PyThread_get_thread_ident();
}

void LongCalls::finish() {
    if (is_busy_) throw Failure("another thread is in a call of this environment or learner");
    if (!left_.valid()) return;
    std::future<void> left = std::move(left_);
    if (left_in_ != ::getpid()) return forget(std::move(left));
    while (true) {
        {
            const nb::gil_scoped_release released;
            if (left.wait_for(between_looks) == std::future_status::ready) break;
        }
        if (PyErr_CheckSignals() == 0) continue;
        left_ = std::move(left);
        throw nb::python_error();
    }
    kept_.reset();
}

void LongCalls::enter() {
    finish();
    is_busy_ = true;
}

LongCalls::Leaving::~Leaving() {
    calls.is_busy_ = false;
    if (std::chrono::steady_clock::now() - begin > is_much)
        calls.aside_ = few;
    else if (calls.aside_ > 0)
        --calls.aside_;
}

void LongCalls::run_aside(std::function<void()> job, nb::handle kept,
                          const std::function<void()>& stop) {
    std::future<void> done = std::async(std::launch::async, std::move(job));
    while (true) {
        {
            const nb::gil_scoped_release released;
            if (done.wait_for(between_looks) == std::future_status::ready) break;
        }
        if (PyErr_CheckSignals() == 0) continue;
        const nb::python_error interrupted;
        if (stop) stop();
        {
            const nb::gil_scoped_release released;
            done.wait_for(longest_wait);
        }
        leave(std::move(done), kept);
        throw interrupted;
    }
    done.get();
}

void LongCalls::leave(std::future<void> job, nb::handle kept) {
    left_ = std::move(job);
    left_in_ = ::getpid();
    kept_ = nb::borrow(kept);
}

}  // namespace rddlc::python
