// The files of a compilation: inputs, and where outputs go.
#pragma once

#include "driver/driver.hpp"
#include "support/files.hpp"

#include <filesystem>
#include <optional>
#include <vector>

namespace rddlc {

enum class OutputKind { Source, Header, SharedObject };
// The kind by the extension: .cpp .cc .cxx, .hpp .hh .h, .so; nothing for any other.
std::optional<OutputKind> output_kind(const std::filesystem::path& path);

// Loads all inputs and checks the outputs' names, before any work is done. Reports files that
// cannot be read or written; `used` gets the files that are read.
std::vector<FileId> read_inputs(const CompileOptions& options, Sources& sources, UsedFiles& used,
                                Diagnostics& diagnostics);

// A file that cannot be written as a diagnostic: "cannot write 'x': No space left on device".
Diagnostic diagnostic_of(const UnwritableFile& failure);

}  // namespace rddlc
