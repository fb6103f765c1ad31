// Native work without Python's lock, which Ctrl-C does not have to wait for.
#pragma once

#include <nanobind/nanobind.h>

#include <chrono>
#include <functional>
#include <future>

namespace rddlc::python {

// The calls of one object, one after the other. Signals reach Python in its main thread alone, so
// work that may take long is done by another thread there, while the main thread looks for signals.
// That is so for the first few calls, and for the next few after one that has taken long; all
// others are done at once.
class LongCalls {
  public:
    explicit LongCalls(bool may_be_long) : aside_(may_be_long ? few : 0) {}
    LongCalls(const LongCalls& other) : aside_(other.aside_) {}
    LongCalls& operator=(const LongCalls&) = delete;
    ~LongCalls();

    // Returns when the job is done, and throws what it throws. On Ctrl-C it calls `stop`, which
    // asks the job to end early, and throws KeyboardInterrupt soon after, even if the job still
    // runs. Then finish() waits for it. `kept`: the objects that the job works with.
    template <class Job>
    void run(const Job& job, nanobind::handle kept = {}, const std::function<void()>& stop = {}) {
        enter();
        const Leaving leaving{*this};
        if (aside_ > 0 && is_main_thread()) return run_aside(job, kept, stop);
        const nanobind::gil_scoped_release released;
        job();
    }

    // Waits for a job that Ctrl-C has left. Refuses while another thread is in a call.
    void finish();

  private:
    struct Leaving {
        LongCalls& calls;
        std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
        ~Leaving();
    };

    void enter();
    void run_aside(std::function<void()> job, nanobind::handle kept,
                   const std::function<void()>& stop);
    void leave(std::future<void> job, nanobind::handle kept);
    static bool is_main_thread();

    static constexpr int few = 3;

    int aside_;  // so many of the next calls
    bool is_busy_ = false;
    std::future<void> left_;
    int left_in_ = 0;  // a process
    nanobind::object kept_;
};

}  // namespace rddlc::python
