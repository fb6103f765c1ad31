// The same work in several threads.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace rddlc::workbench {

// Calls work(0) .. work(count - 1), each once, from several threads on all cores, with a progress
// bar. Stops early once is_interrupted() or when one throws, which then comes out of this. `what`
// is a verb in its -ing form.
void for_each_in_parallel(const std::string& what, std::size_t count,
                          const std::function<void(std::size_t)>& work);

}  // namespace rddlc::workbench
