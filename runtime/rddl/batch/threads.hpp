// A team of threads that works on one job after the other.
#pragma once

#include <rddl/step/range.hpp>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <system_error>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

namespace rddl {

// The worker's share of [0, count). The cuts are at multiples of `unit` where there are enough, so
// that workers write to different cache lines of arrays of bytes.
constexpr Range share_of(int worker, int workers, std::int64_t count, std::int64_t unit) {
    if (workers == 1) return {0, count};  // without two divisions
    const std::int64_t step = count >= unit * workers ? unit : 1;
    const std::int64_t units = count / step;
    const auto cut = [&](std::int64_t k) {
        return k == workers ? count : units * k / workers * step;
    };
    return {cut(worker), cut(worker + 1)};
}

// How a thread waits for a value that another one changes: awake for about as long as it takes to
// wake a thread that sleeps, and then asleep. Awake, it offers its core to others all the time; if
// one takes it, there are not enough cores, and the next times it sleeps at once.
class Waiting {
  public:
    explicit Waiting(bool may_be_awake) : may_be_awake_(may_be_awake) {}

    // Returns when the value is another one.
    template <class T>
    void wait(const std::atomic<T>& value, T old) {
        if (sleeps_ > 0)
            --sleeps_;
        else if (may_be_awake_ && !waits_awake(value, old))
            sleeps_ = 64;
        value.wait(old);
    }

  private:
    // False if another thread had the core meanwhile.
    template <class T>
    static bool waits_awake(const std::atomic<T>& value, T old) {
        using Clock = std::chrono::steady_clock;
        constexpr auto longest = std::chrono::microseconds(50),
                       lost = std::chrono::microseconds(10);
        const auto begin = Clock::now();
        for (auto last = begin, now = begin; now - begin < longest; last = now) {
            if (value.load() != old) return true;
            std::this_thread::yield();
            now = Clock::now();
            if (now - last > lost) return false;
        }
        return true;
    }

    bool may_be_awake_;
    int sleeps_ = 0;  // left, until it tries again
};

// Threads stay awake between jobs for a moment if each may have a core, so that a loop of steps
// need not wake them each time; then they sleep.
class Team {
  public:
    // `size` workers, the calling thread included; fewer if the system gives no more threads.
    explicit Team(int size)
        : waiting_(static_cast<unsigned>(size) <= std::thread::hardware_concurrency()) {
        threads_.reserve(static_cast<std::size_t>(size - 1));
        try {
            for (int worker = 1; worker < size; ++worker)
                threads_.emplace_back([this, worker, its = waiting_] { work(worker, its); });
        } catch (const std::system_error&) {
        }
    }
    Team(const Team&) = delete;
    Team& operator=(const Team&) = delete;
    ~Team() {
        if (threads_.empty()) return;
        stopping_ = true;
        wake();
        for (std::thread& thread : threads_) thread.join();
    }

    int size() const { return static_cast<int>(threads_.size()) + 1; }

    // Calls job(worker) for each worker at the same time and returns when all are done. Throws what
    // a worker has thrown, the first of them if there are several, when all are done.
    template <class Job>
    void run(Job&& job) {
        if (threads_.empty()) return job(0);
        job_ = &job;
        call_ = [](const void* any_job, int worker) {
            (*static_cast<std::remove_reference_t<Job>*>(const_cast<void*>(any_job)))(worker);
        };
        busy_.store(static_cast<int>(threads_.size()), std::memory_order_relaxed);
        wake();
        call(0);
        for (int left = busy_.load(); left != 0; left = busy_.load()) waiting_.wait(busy_, left);
        if (failed_.exchange(false)) std::rethrow_exception(std::exchange(failure_, nullptr));
    }

  private:
    void wake() {
        jobs_given_.fetch_add(1);
        jobs_given_.notify_all();
    }

    void work(int worker, Waiting waiting) {
        for (std::uint32_t jobs_done = 0;; ++jobs_done) {
            waiting.wait(jobs_given_, jobs_done);
            if (stopping_) return;
            call(worker);
            if (busy_.fetch_sub(1) == 1) busy_.notify_one();
        }
    }

    void call(int worker) {
        try {
            call_(job_, worker);
        } catch (...) {
            if (!failed_.exchange(true)) failure_ = std::current_exception();
        }
    }

    std::vector<std::thread> threads_;
    const void* job_ = nullptr;
    void (*call_)(const void* job, int worker) = nullptr;
    std::exception_ptr failure_;  // written by who sets failed_
    std::atomic<bool> failed_ = false;
    bool stopping_ = false;
    Waiting waiting_;  // of the calling thread
    alignas(64) std::atomic<std::uint32_t> jobs_given_ = 0;
    alignas(64) std::atomic<int> busy_ = 0;
};

}  // namespace rddl
