#include "terminal/parallel.hpp"

#include "solvers/evaluation/threads.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/progress.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace rddlc::workbench {

void for_each_in_parallel(std::size_t count, int threads,
                          const std::function<void(std::size_t)>& work) {
    std::atomic<std::size_t> next = 0;
    std::mutex mutex;
    std::exception_ptr failure;  // the first
    const auto work_until_done = [&] {
        try {
            for (std::size_t i = next++; i < count; i = next++) work(i);
        } catch (...) {
            const std::scoped_lock lock(mutex);
            if (!failure) failure = std::current_exception();
            next = count;  // the other threads also stop
        }
    };
    const std::size_t most =
        threads > 0 ? static_cast<std::size_t>(threads) : std::thread::hardware_concurrency();
    const std::size_t wanted = std::min(most, count);
    std::vector<std::thread> others =
        solvers::start_threads(static_cast<int>(wanted) - 1, work_until_done);
    work_until_done();
    for (std::thread& thread : others) thread.join();
    if (failure) std::rethrow_exception(failure);
}

void for_each_with_progress(const std::string& what, std::size_t count,
                            const std::function<void(std::size_t)>& work) {
    Progress progress(what, static_cast<std::int64_t>(count));
    for_each_in_parallel(count, 0, [&](std::size_t i) {
        if (is_interrupted()) return;
        work(i);
        progress.advance();
    });
}

}  // namespace rddlc::workbench
