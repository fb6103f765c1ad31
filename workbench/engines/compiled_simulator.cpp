#include "engines/compiled_simulator.hpp"

#include "support/failure.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>

namespace rddlc::workbench {

namespace fs = std::filesystem;

std::shared_ptr<const rddl_simulator> load_object(const fs::path& object) {
    const auto close = [](void* handle) {
        if (handle) dlclose(handle);
    };
    const std::shared_ptr<void> library(dlopen(object.c_str(), RTLD_NOW | RTLD_LOCAL), close);
    if (!library) return nullptr;
    const auto entry = reinterpret_cast<rddl_simulator_entry_function>(
        dlsym(library.get(), "rddl_simulator_entry"));
    const rddl_simulator* const simulator = entry ? entry() : nullptr;
    if (!simulator || simulator->abi_version != RDDL_ABI_VERSION ||
        simulator->struct_size < sizeof(rddl_simulator))
        return nullptr;
    return {library, simulator};
}

CompiledSimulator compiled_simulator(const std::string& text, const CacheOptions& options) {
    CachedObject object = cached_object(text, options);
    if (auto simulator = load_object(object.path)) return {simulator, object};
    // Compiled by something that has changed since.
    CacheOptions anew = options;
    anew.ignore_cache = true;
    object = cached_object(text, anew);
    if (auto simulator = load_object(object.path)) return {simulator, object};
    const char* const why = dlerror();
    throw Failure(fmt::format("the compiled simulator '{}' cannot be loaded: {}",
                              object.path.string(),
                              why ? why : "it is not a simulator of this version"));
}

}  // namespace rddlc::workbench
