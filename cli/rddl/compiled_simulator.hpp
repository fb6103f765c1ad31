// Emitted text compiled to a shared object and loaded. Shared objects are kept by content under
// $XDG_CACHE_HOME/rddlc (or ~/.cache/rddlc), so that a simulator is compiled once.
#pragma once

#include <rddl/simulator.h>

#include <filesystem>
#include <memory>
#include <string>

namespace rddlc::cli {

struct CacheOptions {
    std::string problem;  // for messages
    bool ignore_cache = false;
    bool quiet = false;
};

// The pointer keeps the library loaded. Fails if there is no C++ compiler.
std::shared_ptr<const rddl_simulator> compiled_simulator(const std::string& text,
                                                         const CacheOptions& options);

std::filesystem::path cache_folder();

}  // namespace rddlc::cli
