#include "terminal/parallel.hpp"

#include "solvers/evaluation/threads.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/progress.hpp"

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace rddlc::workbench {

void for_each_in_parallel(const std::string& what, std::size_t count,
                          const std::function<void(std::size_t)>& work) {
    Progress progress(what, static_cast<std::int64_t>(count));
    std::atomic<std::size_t> next = 0;
    std::mutex mutex;
    std::exception_ptr failure;  // the first
    const auto work_until_done = [&] {
        try {
            for (std::size_t i = next++; i < count && !is_interrupted(); i = next++) {
                work(i);
                progress.advance();
            }
        } catch (...) {
            const std::scoped_lock lock(mutex);
            if (!failure) failure = std::current_exception();
            next = count;  // the other threads also stop
        }
    };
    const int cores = static_cast<int>(std::thread::hardware_concurrency());
    std::vector<std::thread> others = solvers::start_threads(cores - 1, work_until_done);
    work_until_done();
    for (std::thread& thread : others) thread.join();
    if (failure) std::rethrow_exception(failure);
}

}  // namespace rddlc::workbench
