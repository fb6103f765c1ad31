#include "driver/files.hpp"

#include "driver/codes.hpp"
#include "driver/extern_headers.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

namespace rddlc {
namespace {

namespace fs = std::filesystem;

void check_output(const fs::path& output, const CompileOptions& options, Diagnostics& diagnostics) {
    std::vector<fs::path> inputs = options.inputs;
    inputs.insert(inputs.end(), options.extern_headers.begin(), options.extern_headers.end());
    for (const fs::path& input : inputs) {
        std::error_code ignored;
        if (!fs::equivalent(input, output, ignored)) continue;
        const std::string message =
            fmt::format("the output '{}' would overwrite an input", output.string());
        return diagnostics.report({.code = output_is_input, .span = {}, .message = message});
    }
    // /dev/null and pipes are fine, folders are not; all else shows when it is written.
    std::error_code ignored;
    if (fs::is_directory(output, ignored)) {
        return diagnostics.report(cannot_write(output, EISDIR));
    }
    const fs::path folder = output.has_parent_path() ? output.parent_path() : ".";
    if (!fs::is_directory(folder, ignored)) diagnostics.report(cannot_write(output, ENOENT));
}

void check_kind(const fs::path& output, Diagnostics& diagnostics) {
    if (output_kind(output)) return;
    diagnostics.report(Diagnostic{
        .code = unknown_output_kind,
        .span = {},
        .message = fmt::format("cannot tell from its name what '{}' shall be", output.string())}
                           .with_hint("end it in .cpp, .hpp or .so"));
}

}  // namespace

std::optional<OutputKind> output_kind(const fs::path& path) {
    const std::string extension = path.extension().string();
    for (const char* source : {".cpp", ".cc", ".cxx"}) {
        if (extension == source) return OutputKind::Source;
    }
    for (const char* header : {".hpp", ".hh", ".hxx", ".h"}) {
        if (extension == header) return OutputKind::Header;
    }
    if (extension == ".so") return OutputKind::SharedObject;
    return std::nullopt;
}

std::vector<FileId> read_inputs(const CompileOptions& options, Sources& sources,
                                Diagnostics& diagnostics) {
    std::vector<FileId> files;
    for (const fs::path& input : options.inputs) {
        const auto file = sources.load(input);
        if (file) {
            files.push_back(*file);
        } else {
            const std::string message =
                fmt::format("cannot read '{}': {}", input.string(), std::strerror(errno));
            diagnostics.report({.code = unreadable_file, .span = {}, .message = message});
        }
    }
    check_extern_headers(options, diagnostics);
    if (options.output) check_kind(*options.output, diagnostics);
    if (options.output) check_output(*options.output, options, diagnostics);
    if (options.dependency_file) check_output(*options.dependency_file, options, diagnostics);
    return files;
}

TemporaryFile::TemporaryFile(const fs::path& path, std::string_view extension) : final_(path) {
    static std::atomic<int> count = 0;
    const std::string name =
        fmt::format(".{}.{}-{}{}", path.filename().string(), ::getpid(), ++count, extension);
    temporary_ = path.parent_path() / name;
}

TemporaryFile::~TemporaryFile() {
    std::error_code ignored;
    if (!keeps_) fs::remove(temporary_, ignored);
}

bool TemporaryFile::write(std::string_view text) {
    std::ofstream stream(temporary_, std::ios::binary);
    stream.write(text.data(), static_cast<std::streamsize>(text.size()));
    stream.close();
    return !stream.fail();
}

bool TemporaryFile::rename_to_final() {
    std::error_code error;
    fs::rename(temporary_, final_, error);
    if (error) errno = error.value();
    keeps_ = !error;
    return keeps_;
}

bool write_file(const fs::path& path, std::string_view text, Diagnostics& diagnostics) {
    std::error_code ignored;
    // What is no regular file (/dev/stdout) is written to, not replaced.
    if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored)) {
        std::ofstream stream(path, std::ios::binary);
        if (stream << text << std::flush) return true;
    } else {
        TemporaryFile file(path, "");
        if (file.write(text) && file.rename_to_final()) return true;
    }
    diagnostics.report(cannot_write(path, errno));
    return false;
}

Diagnostic cannot_write(const fs::path& path, int error) {
    return {.code = unwritable_file,
            .span = {},
            .message = fmt::format("cannot write '{}': {}", path.string(), std::strerror(error))};
}

}  // namespace rddlc
