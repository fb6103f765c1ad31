// External functions for the interpreter (--extern): from shared objects, or from C++ headers that
// are compiled to one.
#pragma once

#include "engines/load_simulator.hpp"
#include "ir/external_functions.hpp"
#include "problems/problem_lookup.hpp"

#include <filesystem>
#include <memory>
#include <vector>

namespace rddlc::workbench {

// The files that --extern names.
struct ExternFiles {
    std::vector<std::filesystem::path> headers;         // absolute
    std::vector<std::filesystem::path> shared_objects;  // those that end in .so
};
ExternFiles extern_files(const std::vector<std::filesystem::path>& paths);

struct ExternalLibrary {
    std::vector<std::shared_ptr<void>> loaded;  // keeps the functions where they are
    ir::ExternalFunctions functions =
        {};  // by ExternalId; null if the program calls no external functions
};

// All functions that the program calls, each of which accepts its calls; otherwise fails. Headers
// are compiled, and kept as simulators are.
ExternalLibrary external_library(const ir::Program& program, const ProblemFiles& files,
                                 const LoadOptions& options);

}  // namespace rddlc::workbench
