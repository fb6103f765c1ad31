// The C++ compiler of the machine, and how simulators are compiled with it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rddlc::cli {

struct CxxCompiler {
    std::vector<std::string> command;  // "g++", or "ccache", "g++"
    std::string version;               // what it says about itself
};

// $CXX, else c++, g++ or clang++, whichever runs first. Nothing if none does.
std::optional<CxxCompiler> find_cxx_compiler();

// Where <rddl/...> is found: $RDDLC_RUNTIME, beside the installed program, or in the source tree.
std::filesystem::path runtime_folder();

// For a shared object that exports rddl_simulator_entry.
std::vector<std::string> simulator_flags();

// Fails with what the compiler said.
void compile_simulator(const CxxCompiler& compiler, const std::filesystem::path& source,
                       const std::filesystem::path& shared_object);

}  // namespace rddlc::cli
