#include "parallel.hpp"

#include "interrupt.hpp"
#include "progress.hpp"

#include <atomic>
#include <thread>
#include <vector>

namespace rddlc::cli {

void for_each_in_parallel(const std::string& what, std::size_t count,
                          const std::function<void(std::size_t)>& work) {
    Progress progress(what, static_cast<std::int64_t>(count));
    std::atomic<std::size_t> next = 0;
    const auto work_until_done = [&] {
        for (std::size_t i = next++; i < count && !is_interrupted(); i = next++) {
            work(i);
            progress.advance();
        }
    };
    std::vector<std::thread> others;
    for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i)
        others.emplace_back(work_until_done);
    work_until_done();
    for (std::thread& thread : others) thread.join();
}

}  // namespace rddlc::cli
