#include "solvers/evaluation/threads.hpp"

#include <future>
#include <new>
#include <system_error>

namespace rddlc::solvers {

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

}  // namespace rddlc::solvers
