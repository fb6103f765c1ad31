// The same work for many things, on all cores, with a progress bar.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace rddlc::cli {

// Calls work(0) .. work(count - 1), each once, from several threads. Stops early once
// is_interrupted(). `work` must not throw. `what` is a verb in its -ing form.
void for_each_in_parallel(const std::string& what, std::size_t count,
                          const std::function<void(std::size_t)>& work);

}  // namespace rddlc::cli
