// Ctrl-C in the middle of work. No loop over environments, actions, objects or samples may run for
// more than a second or so without looking.
#pragma once

#include <functional>

namespace rddlc::solvers {

// Returns whether to end early. All threads call it often. It stays true once it was. Work that
// ends early leaves valid values, but not those of complete work: the caller also asks and discards
// them.
using Stops = std::function<bool()>;

// A null pointer or an empty function never stops.
inline bool is_stopped(const Stops* stops) {
    return stops && *stops && (*stops)();
}

}  // namespace rddlc::solvers
