// The same work in several threads.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace rddlc::cli {

// Threads that work beside the calling one: so many, or fewer if the system gives no more. Where it
// does not, half of those that it gave are ended again before they work, so that something is left
// for the work itself. `work` must not throw; the caller joins.
std::vector<std::thread> start_threads(int wanted, const std::function<void()>& work);

// Calls work(0) .. work(count - 1), each once, from several threads on all cores, with a progress
// bar. Stops early once is_interrupted() or when one throws, which then comes out of this. `what`
// is a verb in its -ing form.
void for_each_in_parallel(const std::string& what, std::size_t count,
                          const std::function<void(std::size_t)>& work);

}  // namespace rddlc::cli
