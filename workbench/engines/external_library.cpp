#include "engines/external_library.hpp"

#include "cache/object_cache.hpp"
#include "emit/emit.hpp"
#include "ir/analysis.hpp"
#include "ir/call.hpp"
#include "support/failure.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

namespace rddlc::workbench {

namespace fs = std::filesystem;

namespace {

// An empty name has no full name, and neither has any if the current folder is gone: reading the
// file reports the error.
fs::path full_name(const fs::path& path) {
    std::error_code error;
    const fs::path full = fs::absolute(path, error);
    return error ? path : full.lexically_normal();
}

std::shared_ptr<void> load_library(const fs::path& object) {
    const auto close = [](void* handle) {
        if (handle) dlclose(handle);
    };
    // A path without a slash would be searched for elsewhere.
    const std::shared_ptr<void> library(dlopen(full_name(object).c_str(), RTLD_NOW | RTLD_LOCAL),
                                        close);
    if (library) return library;
    const char* const why = dlerror();
    throw Failure(fmt::format("cannot load '{}': {}", object.string(), why ? why : "no reason"));
}

std::shared_ptr<void> load_headers(const ir::Program& program, const std::vector<fs::path>& headers,
                                   const ProblemFiles& files, const LoadOptions& options) {
    std::vector<std::string> included;
    for (const fs::path& header : headers) included.push_back(header.string());
    const CachedObject object = cached_object(
        emit_external_library(program, included),
        {"the external functions of " + files.name, options.ignore_cache, options.quiet, headers});
    return load_library(object.path);
}

std::vector<ir::Call> external_calls(const ir::Program& program) {
    std::vector<ir::Call> calls;
    for (const ir::Block* block : ir::blocks_of(program)) {
        ir::for_each_statement<ir::Call>(*block, [&](const ir::Call& call) {
            if (ir::is_external(call.callee)) calls.push_back(call);
        });
    }
    return calls;
}

rddl_external_function find_function(const std::string& name, const ExternalLibrary& library) {
    const std::string entry = external_entry(name);
    for (const std::shared_ptr<void>& object : library.loaded)
        if (void* const address = dlsym(object.get(), entry.c_str()))
            return reinterpret_cast<rddl_external_function>(address);
    throw Failure(fmt::format("the shared object has no function '{}' for '${}'", entry, name),
                  "export it with RDDL_EXTERN of <rddl/external.hpp>");
}

}  // namespace

ExternFiles extern_files(const std::vector<fs::path>& paths) {
    ExternFiles files;
    for (const fs::path& path : paths) {
        if (path.extension() == ".so")
            files.shared_objects.push_back(path);
        else
            files.headers.push_back(full_name(path));
    }
    return files;
}

ExternalLibrary external_library(const ir::Program& program, const ProblemFiles& files,
                                 const LoadOptions& options) {
    ExternalLibrary library;
    const std::vector<ir::Call> calls = external_calls(program);
    if (calls.empty()) return library;
    const auto [headers, shared_objects] = extern_files(options.externs);
    for (const fs::path& object : shared_objects) library.loaded.push_back(load_library(object));
    if (!headers.empty()) library.loaded.push_back(load_headers(program, headers, files, options));
    library.functions.resize(program.externals.size());
    for (const ir::Call& call : calls) {
        const auto id = std::get<ir::ExternalId>(call.callee);
        const std::string& name = program[id].name;
        rddl_external_function& function = library.functions[id.index];
        if (!function) function = find_function(name, library);
        if (!ir::accepts(function, program, call))
            throw Failure(fmt::format("'{}' of the shared object cannot be called as {}",
                                      external_entry(name), external_signature(program, call)),
                          "export it with this signature, or with spans of any size");
    }
    return library;
}

}  // namespace rddlc::workbench
