#include "driver/files.hpp"

#include "driver/codes.hpp"
#include "driver/extern_headers.hpp"
#include "support/suggestion.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

namespace rddlc {
namespace {

namespace fs = std::filesystem;

// False, and a diagnostic, if it is clear already that it cannot be written.
bool check_place(const fs::path& output, const UsedFiles& used, Diagnostics& diagnostics) {
    try {
        require_writable(output, used);
    } catch (const UnwritableFile& failure) {
        diagnostics.report(diagnostic_of(failure));
        return false;
    }
    return true;
}

void check_kind(const fs::path& output, Diagnostics& diagnostics) {
    if (output_kind(output)) return;
    diagnostics.report(Diagnostic{
        .code = unknown_output_kind,
        .span = {},
        .message = fmt::format("the name '{}' does not show the kind of output", output.string())}
                           .with_hint("end it in .cpp, .hpp or .so"));
}

// Runs before any work is done, so that errors come at once. The name of a folder shows no kind,
// and one error is enough.
void check_outputs(const CompileOptions& options, UsedFiles used, Diagnostics& diagnostics) {
    for (const auto& output : {options.output, options.declaration_file, options.dependency_file}) {
        if (!output) continue;
        if (check_place(*output, used, diagnostics) && output == options.output)
            check_kind(*output, diagnostics);
        used.add(*output);
    }
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

namespace {

// The hint for a file that cannot be read, where `error` is one of <cerrno>: a file in the folder
// of a problem, and the nearest name where there is no such file.
std::string hint_of_unreadable(const fs::path& input, int error) {
    const fs::path domain = input / "domain.rddl";
    if (error == EISDIR && is_there(domain))
        return fmt::format("name the files in it, such as {}", domain.string());
    if (error != ENOENT) return "";
    std::vector<std::string> names;
    std::error_code ignored;
    const fs::path folder = input.has_parent_path() ? input.parent_path() : ".";
    for (const auto& entry : fs::directory_iterator(folder, ignored))
        names.push_back((input.parent_path() / entry.path().filename()).string());
    return hint_of_name(did_you_mean(input.string(), names));
}

void report_unreadable(const fs::path& input, int error, Diagnostics& diagnostics) {
    diagnostics.report(
        {.code = unreadable_file,
         .span = {},
         .message = fmt::format("cannot read '{}': {}", input.string(), std::strerror(error)),
         .hint = hint_of_unreadable(input, error)});
}

}  // namespace

std::vector<FileId> read_inputs(const CompileOptions& options, Sources& sources, UsedFiles& used,
                                Diagnostics& diagnostics) {
    std::vector<fs::path> inputs = options.inputs;
    if (options.policy) inputs.push_back(*options.policy);
    std::vector<FileId> files;
    for (const fs::path& input : inputs) {
        const auto text = options.texts.find(input);
        const auto file = text != options.texts.end() ? sources.add(input.string(), text->second)
                                                      : sources.load(input);
        if (!file) report_unreadable(input, errno, diagnostics);
        used.add(input);
        if (file) files.push_back(*file);
    }
    check_extern_headers(options, diagnostics);
    for (const fs::path& header : with_included_files(options.extern_headers)) used.add(header);
    check_outputs(options, used, diagnostics);
    return files;
}

Diagnostic diagnostic_of(const UnwritableFile& failure) {
    const bool in_use = failure.reason == UnwritableFile::Reason::InUse;
    return {.code = in_use ? output_is_input : unwritable_file,
            .span = {},
            .message = failure.what(),
            .hint = failure.hint};
}

}  // namespace rddlc
