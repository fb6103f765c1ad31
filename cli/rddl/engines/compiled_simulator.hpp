// Emitted text compiled to a shared object and loaded.
#pragma once

#include "cache/object_cache.hpp"

#include <rddl/simulator.h>

#include <memory>
#include <string>

namespace rddlc::cli {

struct CompiledSimulator {
    std::shared_ptr<const rddl_simulator> simulator;  // keeps the library loaded
    CachedObject object;
};

// Fails if there is no C++ compiler.
CompiledSimulator compiled_simulator(const std::string& text, const CacheOptions& options);

}  // namespace rddlc::cli
