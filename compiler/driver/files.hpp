// Reading inputs and writing outputs.
#pragma once

#include "driver/driver.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc {

enum class OutputKind { Source, Header, SharedObject };
// By the extension: .cpp .cc .cxx, .hpp .hh .h, .so; nothing for any other.
std::optional<OutputKind> output_kind(const std::filesystem::path& path);

// Loads all inputs and looks at the outputs' names, before any work is done. Reports what cannot be
// read or written.
std::vector<FileId> read_inputs(const CompileOptions& options, Sources& sources,
                                Diagnostics& diagnostics);

// A name in the folder of `path` that nobody else uses. It is removed on destruction unless it has
// been renamed to `path`: so a file has its final name only when it is complete.
class TemporaryFile {
  public:
    // `extension` such as ".cpp", for programs that look at it.
    TemporaryFile(const std::filesystem::path& path, std::string_view extension);
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile();

    const std::filesystem::path& path() const { return temporary_; }
    // Both false with errno set on failure.
    bool write(std::string_view text);
    bool rename_to_final();

  private:
    std::filesystem::path final_;
    std::filesystem::path temporary_;
    bool keeps_ = false;
};

// Reports the error if it fails.
bool write_file(const std::filesystem::path& path, std::string_view text, Diagnostics& diagnostics);

// "cannot write 'x': No space left on device"
Diagnostic cannot_write(const std::filesystem::path& path, int error);

}  // namespace rddlc
