// Ctrl-C in the middle of work. No loop over environments, actions, objects or samples may run for
// more than a second or so without looking.
#pragma once

#include <functional>

namespace rddlc::solvers {

// Whether to end early; asked by all threads, often. It stays true once it was. Work that ends
// early leaves valid values, but not those of whole work: the caller asks, too, and throws them
// away.
using Stops = std::function<bool()>;

// Of a null pointer or an empty function: never.
inline bool is_stopped(const Stops* stops) {
    return stops && *stops && (*stops)();
}

}  // namespace rddlc::solvers
