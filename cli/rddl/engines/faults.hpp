// Run-time faults as text.
#pragma once

#include <rddl/simulator.h>

#include <cstdint>
#include <string>

namespace rddlc::cli {

// The message, which begins with its place "file:line:column", or nothing if the environment has
// not faulted.
std::string fault_text(const rddl_simulator& simulator, const rddl_batch& batch,
                       std::int64_t environment);

// "file:line:column"
std::string source_text(const rddl_source& source);

}  // namespace rddlc::cli
