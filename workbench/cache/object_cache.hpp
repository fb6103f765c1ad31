// C++ text compiled to a shared object. Shared objects are kept by content under
// $XDG_CACHE_HOME/rddlc (or ~/.cache/rddlc), so that a text is compiled once.
#pragma once

#include "ir/ir.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace rddlc::workbench {

struct CacheOptions {
    std::string what;  // for messages
    bool ignore_cache = false;
    bool quiet = false;
    // The user's headers that the text includes: a change to one is a change to the text.
    std::vector<std::filesystem::path> extern_headers = {};
    // The reals of the batches that the text links, which are the same for all simulators; nothing
    // if it links no batches.
    std::optional<RealType> linked_batches = std::nullopt;
    // Called with `what` before something is compiled; empty: a terminal shows it.
    std::function<void(const std::string&)> on_begin = {};
    // A build in the background can be stopped: compilers end, and nothing is left. Only some
    // of these run at a time, and errors are reported by the exception alone.
    std::stop_token stop = {};
};

struct CachedObject {
    std::filesystem::path path;
    std::optional<double> build_seconds;  // nothing if it was there already
};

// Fails if there is no C++ compiler or no folder for it (cache_folder.hpp); throws Diagnosed if the
// compiler refuses the user's headers. A process that ends meanwhile leaves no part of an object.
// If several processes want the same object, one of them makes it.
CachedObject cached_object(const std::string& text, const CacheOptions& options);

}  // namespace rddlc::workbench
