// Emitted text compiled to a shared object and loaded.
#pragma once

#include "object_cache.hpp"

#include <rddl/simulator.h>

#include <memory>
#include <string>

namespace rddlc::cli {

// The pointer keeps the library loaded. Fails if there is no C++ compiler.
std::shared_ptr<const rddl_simulator> compiled_simulator(const std::string& text,
                                                         const CacheOptions& options);

}  // namespace rddlc::cli
