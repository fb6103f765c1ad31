#include "driver/write.hpp"

#include "driver/extern_headers.hpp"
#include "driver/files.hpp"
#include "driver/shared_object.hpp"

#include <cerrno>

namespace rddlc {
namespace {

// As make reads it.
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
    for (const auto& header : with_included_files(options.extern_headers)) {
        rule += " \\\n  " + escaped(header.string());
    }
    return rule + "\n";
}

void write_shared_object(const std::filesystem::path& output, const std::string& text,
                         const CompileOptions& options, Diagnostics& diagnostics) {
    TemporaryFile source(output, ".cpp");
    TemporaryFile object(output, ".so");
    if (!source.write(text)) return diagnostics.report(cannot_write(output, errno));
    if (!build_shared_object(source.path(), object.path(), Processors::Any, options.extern_headers,
                             diagnostics)) {
        return;
    }
    if (!object.rename_to_final()) diagnostics.report(cannot_write(output, errno));
}

}  // namespace

void write_outputs(const CompileOptions& options, const std::string& text,
                   Diagnostics& diagnostics) {
    if (!options.output) return;
    if (output_kind(*options.output) == OutputKind::SharedObject) {
        write_shared_object(*options.output, text, options, diagnostics);
    } else {
        write_file(*options.output, text, diagnostics);
    }
    if (diagnostics.has_errors() || !options.dependency_file) return;
    write_file(*options.dependency_file, dependency_rule(options), diagnostics);
}

}  // namespace rddlc
