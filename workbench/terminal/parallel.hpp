// The same work in several threads.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace rddlc::workbench {

// Calls work(0) .. work(count - 1), each once, from so many threads (0: one per core). Stops early
// when one throws, which then comes out of this.
void for_each_in_parallel(std::size_t count, int threads,
                          const std::function<void(std::size_t)>& work);

// The same on all cores, with a progress bar. Also stops early once is_interrupted(). `what` is a
// verb in its -ing form.
void for_each_with_progress(const std::string& what, std::size_t count,
                            const std::function<void(std::size_t)>& work);

}  // namespace rddlc::workbench
