#include "driver/extern_headers.hpp"

#include "driver/codes.hpp"
#include "driver/files.hpp"
#include "ir/analysis.hpp"
#include "support/text_hash.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <string_view>

namespace rddlc {
namespace {

namespace fs = std::filesystem;

// The name in a line `#include "name"`.
std::optional<std::string_view> included_name(std::string_view line) {
    for (const std::string_view part : {"#", "include", "\""}) {
        const std::size_t begin = std::min(line.find_first_not_of(" \t"), line.size());
        line.remove_prefix(begin);
        if (!line.starts_with(part)) return std::nullopt;
        line.remove_prefix(part.size());
    }
    const std::size_t end = line.find('"');
    if (end == line.npos) return std::nullopt;
    return line.substr(0, end);
}

std::vector<fs::path> included_by(const fs::path& file) {
    std::vector<fs::path> included;
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) return included;
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) {
        const auto name = included_name(line);
        if (!name) continue;
        const fs::path path = (file.parent_path() / *name).lexically_normal();
        if (fs::is_regular_file(path, ignored)) included.push_back(path);
    }
    return included;
}

// Headers are read more than once, and to their end.
std::optional<std::string> why_unreadable(const fs::path& header) {
    std::error_code ignored;
    const fs::file_type type = fs::status(header, ignored).type();
    if (type == fs::file_type::directory) return std::strerror(EISDIR);
    if (fs::exists(fs::file_status(type)) && type != fs::file_type::regular)
        return "it is not a regular file";
    return std::ifstream(header) ? std::nullopt : std::optional<std::string>(std::strerror(errno));
}

// The name stays as it is if the current folder is gone.
fs::path full_name(const fs::path& path) {
    std::error_code error;
    const fs::path full = fs::absolute(path, error);
    return error ? path : full;
}

}  // namespace

void check_extern_headers(const CompileOptions& options, Diagnostics& diagnostics) {
    for (const fs::path& header : options.extern_headers) {
        if (const auto why = why_unreadable(header))
            diagnostics.report(
                {.code = unreadable_file,
                 .span = {},
                 .message = fmt::format("cannot read '{}': {}", header.string(), *why)});
    }
}

void report_undefined_externals(const ir::Program& program, const CompileOptions& options,
                                Diagnostics& diagnostics) {
    if (!options.extern_headers.empty()) return;
    std::set<ir::ExternalId> reported;
    for (const ir::Block* block : ir::blocks_of(program)) {
        ir::for_each_statement<ir::Call>(*block, [&](const ir::Call& call) {
            const auto* id = std::get_if<ir::ExternalId>(&call.callee);
            if (!id || !reported.insert(*id).second) return;
            const ir::External& external = program[*id];
            diagnostics.report(Diagnostic{
                .code = undefined_external,
                .span = external.span,
                .message =
                    fmt::format("nothing defines the external function '${}'", external.name)}
                                   .with_hint("name the C++ header that does: --extern FILE.hpp"));
        });
    }
}

std::vector<std::string> include_paths(const CompileOptions& options) {
    std::vector<std::string> paths;
    for (const fs::path& header : options.extern_headers) {
        std::error_code ignored;
        fs::path path = header;
        if (options.output)
            path = fs::relative(header, full_name(*options.output).parent_path(), ignored);
        // The text of a shared object is compiled elsewhere.
        const bool elsewhere =
            options.output && output_kind(*options.output) == OutputKind::SharedObject;
        if (elsewhere || path.empty()) path = full_name(header);
        paths.push_back(path.generic_string());
    }
    return paths;
}

std::vector<fs::path> with_included_files(const std::vector<fs::path>& headers) {
    std::vector<fs::path> files;
    std::vector<fs::path> waiting(headers.rbegin(), headers.rend());
    while (!waiting.empty()) {
        const fs::path file = waiting.back();
        waiting.pop_back();
        if (std::ranges::find(files, file) != files.end()) continue;
        files.push_back(file);
        const std::vector<fs::path> included = included_by(file);
        waiting.insert(waiting.end(), included.rbegin(), included.rend());
    }
    return files;
}

std::uint64_t with_extern_headers(std::uint64_t fingerprint, const CompileOptions& options) {
    TextHash hash;
    hash.add(fingerprint);
    for (const fs::path& file : with_included_files(options.extern_headers)) {
        std::ifstream stream(file, std::ios::binary);
        hash.add(std::string(std::istreambuf_iterator<char>(stream), {}));
    }
    return hash.value();
}

}  // namespace rddlc
