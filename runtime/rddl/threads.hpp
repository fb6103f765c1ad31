// A team of threads that sleeps between jobs.
#pragma once

#include <atomic>
#include <cstdint>
#include <system_error>
#include <thread>
#include <type_traits>
#include <vector>

namespace rddl {

// A half-open range of blocks of environments.
struct Range {
    std::int64_t begin;
    std::int64_t end;
};

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

class Team {
  public:
    // `size` workers, the calling thread included; fewer if the system gives no more threads.
    explicit Team(int size) {
        threads_.reserve(static_cast<std::size_t>(size - 1));
        try {
            for (int worker = 1; worker < size; ++worker)
                threads_.emplace_back([this, worker] { work(worker); });
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

    // Calls job(worker) for each worker at the same time and returns when all are done. The job
    // must not throw.
    template <class Job>
    void run(Job&& job) {
        if (threads_.empty()) return job(0);
        job_ = &job;
        call_ = [](const void* any_job, int worker) {
            (*static_cast<std::remove_reference_t<Job>*>(const_cast<void*>(any_job)))(worker);
        };
        busy_.store(static_cast<int>(threads_.size()), std::memory_order_relaxed);
        wake();
        job(0);
        for (int left = busy_.load(); left != 0; left = busy_.load()) busy_.wait(left);
    }

  private:
    void wake() {
        jobs_given_.fetch_add(1);
        jobs_given_.notify_all();
    }

    void work(int worker) {
        for (std::uint32_t jobs_done = 0;; ++jobs_done) {
            jobs_given_.wait(jobs_done);
            if (stopping_) return;
            call_(job_, worker);
            if (busy_.fetch_sub(1) == 1) busy_.notify_one();
        }
    }

    std::vector<std::thread> threads_;
    const void* job_ = nullptr;
    void (*call_)(const void* job, int worker) = nullptr;
    bool stopping_ = false;
    alignas(64) std::atomic<std::uint32_t> jobs_given_ = 0;
    alignas(64) std::atomic<int> busy_ = 0;
};

}  // namespace rddl
