#include "rollouts/parallel.hpp"

#include "terminal/interrupt.hpp"
#include "terminal/progress.hpp"

#include <atomic>
#include <exception>
#include <future>
#include <mutex>
#include <new>
#include <system_error>

namespace rddlc::cli {

std::vector<std::thread> start_threads(int wanted, const std::function<void()>& work) {
    std::vector<std::thread> threads;
    std::promise<std::size_t> decision;  // how many of them work
    const std::shared_future<std::size_t> working = decision.get_future().share();
    bool all = true;
    try {
        for (int i = 0; i < wanted; ++i)
            threads.emplace_back([working, work, number = threads.size()] {
                if (number < working.get()) work();
            });
    } catch (const std::system_error&) {
        all = false;
    } catch (const std::bad_alloc&) {
        all = false;
    }
    const std::size_t count = all ? threads.size() : threads.size() / 2;
    decision.set_value(count);
    for (std::size_t i = count; i < threads.size(); ++i) threads[i].join();
    threads.resize(count);
    return threads;
}

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
            next = count;  // the other threads stop, too
        }
    };
    const int cores = static_cast<int>(std::thread::hardware_concurrency());
    std::vector<std::thread> others = start_threads(cores - 1, work_until_done);
    work_until_done();
    for (std::thread& thread : others) thread.join();
    if (failure) std::rethrow_exception(failure);
}

}  // namespace rddlc::cli
