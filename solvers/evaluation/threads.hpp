// The same work in several threads.
#pragma once

#include <functional>
#include <thread>
#include <vector>

namespace rddlc::solvers {

// The largest number of threads that a user may ask for.
inline constexpr int most_threads = 4096;

// Threads that work beside the calling one: so many, or fewer if the system gives no more. Where it
// does not, half of those that it gave are ended again before they work, so that something is left
// for the work itself. `work` must not throw; the caller joins.
std::vector<std::thread> start_threads(int wanted, const std::function<void()>& work);

}  // namespace rddlc::solvers
