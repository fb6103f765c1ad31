// Why the last call of the C interface failed, for each thread (rddl_simulator::last_error).
#pragma once

#include <rddl/interface/fixed_text.hpp>
#include <rddl/simulator.h>

#include <span>

namespace rddl {

inline std::span<char> last_error_buffer() {
    thread_local char buffer[512] = "";
    return buffer;
}

// A sentence without a full stop: "environments 3 to 5 do not exist, there are 4".
template <class... Parts>
[[gnu::cold, gnu::noinline]] rddl_error fail(rddl_error error, const Parts&... parts) {
    FixedText text(last_error_buffer());
    (text << ... << parts);
    return error;
}
template <class... Parts>
rddl_error bad_argument(const Parts&... parts) {
    return fail(RDDL_BAD_ARGUMENT, parts...);
}
inline rddl_error out_of_memory() {
    return fail(RDDL_OUT_OF_MEMORY, std::string_view("out of memory"));
}

}  // namespace rddl
