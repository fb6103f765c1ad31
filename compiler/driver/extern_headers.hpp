// The C++ headers that define external functions (--extern).
#pragma once

#include "driver/driver.hpp"
#include "ir/ir.hpp"
#include "support/diagnostic.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rddlc {

// Reports those that cannot be read.
void check_extern_headers(const CompileOptions& options, Diagnostics& diagnostics);

// Reports the external functions that the program calls although no header defines any.
void report_undefined_externals(const ir::Program& program, const CompileOptions& options,
                                Diagnostics& diagnostics);

// The headers as #include finds them from the folder of the output; as given without one,
// and in full for a shared object.
std::vector<std::string> include_paths(const CompileOptions& options);

// A fingerprint of dynamics, to which those of the headers are added.
std::uint64_t with_extern_headers(std::uint64_t fingerprint, const CompileOptions& options);

// The headers and the files that they #include by "name", as far as these exist: what an emitted
// file depends on.
std::vector<std::filesystem::path> with_included_files(
    const std::vector<std::filesystem::path>& headers);

}  // namespace rddlc
