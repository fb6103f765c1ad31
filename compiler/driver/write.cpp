#include "driver/write.hpp"

#include "driver/extern_headers.hpp"
#include "driver/files.hpp"
#include "driver/shared_object.hpp"
#include "driver/work_folder.hpp"

namespace rddlc {
namespace {

// The path as make reads it.
std::string escaped(const std::string& path) {
    std::string result;
    for (char c : path) {
        if (c == ' ' || c == '#' || c == '\\') result += '\\';
        if (c == '$') result += '$';
        result += c;
    }
    return result;
}

std::string dependency_rule(const CompileOptions& options) {
    std::string rule = escaped(options.output->string()) + ":";
    for (const auto& input : options.inputs) rule += " \\\n  " + escaped(input.string());
    if (options.policy) rule += " \\\n  " + escaped(options.policy->string());
    for (const auto& header : with_included_files(options.extern_headers)) {
        rule += " \\\n  " + escaped(header.string());
    }
    return rule + "\n";
}

// The object is made in a folder of its own, so that no program reads an incomplete one.
void write_shared_object(const std::filesystem::path& output, const std::string& text,
                         const CompileOptions& options, UsedFiles& used, Diagnostics& diagnostics) {
    const TemporaryFolder work;
    const auto source = work.path() / "simulator.cpp", object = work.path() / "simulator.so";
    write_file(source, text, used);
    std::optional<std::filesystem::path> prepared;
    if (!options.portable && options.prepared_runtime) prepared = options.prepared_runtime();
    const Processors processors = options.portable ? Processors::Any : Processors::LikeThis;
    if (!build_shared_object(source, object, processors, options.extern_headers, diagnostics,
                             prepared))
        return;
    constexpr mode_t executable = 0777;
    write_file(output, read_file(object), used, executable);
}

}  // namespace

void write_outputs(const CompileOptions& options, const OutputTexts& texts, UsedFiles& used,
                   Diagnostics& diagnostics) {
    if (!options.output) return;
    try {
        if (output_kind(*options.output) == OutputKind::SharedObject)
            write_shared_object(*options.output, texts.cpp, options, used, diagnostics);
        else
            write_file(*options.output, texts.cpp, used);
        if (diagnostics.has_errors()) return;
        if (options.declaration_file)
            write_file(*options.declaration_file, texts.declaration, used);
        if (options.dependency_file)
            write_file(*options.dependency_file, dependency_rule(options), used);
    } catch (const UnwritableFile& failure) {
        diagnostics.report(diagnostic_of(failure));
    }
}

}  // namespace rddlc
