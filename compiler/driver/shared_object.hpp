// Emitted text -> shared object, by the machine's C++ compiler.
#pragma once

#include "ir/ir.hpp"
#include "support/diagnostic.hpp"

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace rddlc {

// The folder that holds rddl/simulator.hpp: $RDDLC_INCLUDE, the one installed beside the running
// program or the library that this is part of, or that of the source tree from which it was built.
// Nothing if there is no such folder.
std::optional<std::filesystem::path> runtime_include_folder();

// The error in RDDLC_INCLUDE or RDDL_INSTRUCTION_SET, if they are set.
std::optional<std::string> complaint_about_environment();

// The target processors: any of the architecture, or those with the vector registers of this one
// (fewer if RDDL_INSTRUCTION_SET says so: rddl/lanes/processor.hpp).
enum class Processors { Any, LikeThis };

// The compiler and its arguments: $CXX (split at blanks) or c++.
std::vector<std::string> shared_object_command(const std::filesystem::path& source,
                                               const std::filesystem::path& output,
                                               Processors processors,
                                               const std::stop_token& stop = {});

// Compiles into a folder what is the same for all simulators for processors like this one: the code
// of batches with that type of reals (rddl/batches.cpp), which they can link, and, if the compiler
// can do that, the headers that they include. False if there is no such code afterwards.
// `stop` ends the compilers (run_process).
bool prepare_runtime(const std::filesystem::path& folder, RealType real,
                     const std::stop_token& stop = {});

// Whether that code serves simulators with packs of so many environments; absent: with as many as
// are chosen for the problem.
bool has_prepared_batches(std::optional<int> lane_count);

// An object for any processor of x86-64 holds the simulator for each instruction set; its entry
// chooses when it is called. For those like this one, it is made with the files that
// prepare_runtime has put into the folder `prepared`, if there is one, as far as the compiler
// accepts them; otherwise all is compiled. A precompiled header that it refuses is removed.
//
// False, with the reason reported, if there is no compiler or no runtime, if the compiler fails, or
// if it refuses a text that includes the user's headers. If it finds a mistake in a text of ours
// alone (compiler_failure.hpp), it throws std::logic_error with the compiler's messages. Also
// throws UnwritableFile.
bool build_shared_object(const std::filesystem::path& source, const std::filesystem::path& output,
                         Processors processors,
                         const std::vector<std::filesystem::path>& extern_headers,
                         Diagnostics& diagnostics,
                         const std::optional<std::filesystem::path>& prepared = {},
                         const std::stop_token& stop = {});

}  // namespace rddlc
