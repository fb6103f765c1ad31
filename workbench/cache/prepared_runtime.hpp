// Code that all simulators share, compiled once: the code of batches and the runtime's headers.
#pragma once

#include "ir/ir.hpp"

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>

namespace rddlc::workbench {

// The dependencies of compiled code besides its own text: the runtime's headers, the compiler's
// command line and its version.
std::string toolchain_text(const std::stop_token& stop = {});  // fails on an interrupt or stop

// The folder within `cache` that prepare_runtime (driver/shared_object.hpp) fills for that
// toolchain and type of reals, now or earlier, intact; nothing if it cannot. Removes all others
// except the latest few. `stop` makes it fail soon.
std::optional<std::filesystem::path> prepared_runtime(const std::filesystem::path& cache,
                                                      const std::string& toolchain, RealType real,
                                                      const std::stop_token& stop = {});

}  // namespace rddlc::workbench
