// A program compiled to a shared object and loaded. Shared objects are kept by content under
// $XDG_CACHE_HOME/rddlc (or ~/.cache/rddlc), so that a simulator is compiled once.
#pragma once

#include "ir/ir.hpp"
#include "support/source.hpp"

#include <rddl/simulator.h>

#include <filesystem>
#include <memory>
#include <string>

namespace rddlc::cli {

struct CompileOptions {
    std::string problem;  // for messages
    bool ignore_cache = false;
    bool quiet = false;
};

// The pointer keeps the library loaded. Fails if there is no C++ compiler.
std::shared_ptr<const rddl_simulator> compiled_simulator(const ir::Program& program,
                                                         const Sources& sources,
                                                         const CompileOptions& options);

std::filesystem::path cache_folder();

// A simulator from a shared object; null if the file is not one of this ABI version.
std::shared_ptr<const rddl_simulator> load_shared_object(const std::filesystem::path& path);

}  // namespace rddlc::cli
