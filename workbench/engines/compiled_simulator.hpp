// Emitted text compiled to a shared object and loaded.
#pragma once

#include "cache/object_cache.hpp"

#include <rddl/simulator.h>

#include <filesystem>
#include <memory>
#include <string>

namespace rddlc::workbench {

struct CompiledSimulator {
    std::shared_ptr<const rddl_simulator> simulator;  // keeps the library loaded
    CachedObject object;
};

// Loads a simulator from a shared object; null if the file is not one of this ABI version.
std::shared_ptr<const rddl_simulator> load_object(const std::filesystem::path& object);

// Fails without a C++ compiler.
CompiledSimulator compiled_simulator(const std::string& text, const CacheOptions& options);

}  // namespace rddlc::workbench
