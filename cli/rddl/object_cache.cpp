#include "object_cache.hpp"

#include "driver/extern_headers.hpp"
#include "driver/shared_object.hpp"
#include "failure.hpp"
#include "interrupt.hpp"
#include "prepared_runtime.hpp"
#include "progress.hpp"
#include "read_text.hpp"
#include "sha256.hpp"
#include "support/render.hpp"
#include "work_folder.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace rddlc::cli {

namespace fs = std::filesystem;

namespace {

// The user's headers with what they include.
std::string extern_text(const std::vector<fs::path>& headers) {
    std::string text;
    for (const fs::path& file : with_included_files(headers))
        text += file.string() + '\0' + read_text(file) + '\0';
    return text;
}

// Everything that the compiled code depends on.
std::string content_key(const std::string& text, const std::string& toolchain,
                        const CacheOptions& options) {
    return sha256(fmt::format("{}\n{}\n{}", text, toolchain, extern_text(options.extern_headers)));
}

// Tells on a terminal what takes so long.
class CompilingMessage {
  public:
    CompilingMessage(const std::string& problem, bool shown) : shown_(shown && is_terminal(2)) {
        if (shown_) fmt::print(stderr, "compiling {} ...", problem);
    }
    // The seconds that it took.
    double done() const {
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin_;
        if (shown_) fmt::print(stderr, " ({})\n", duration_text(elapsed.count()));
        return elapsed.count();
    }

  private:
    bool shown_;
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

// A shared object in the cache ends with the hash of what stands before it (the loader does not
// mind), since loading a file that is cut off may kill the process.
constexpr std::size_t seal_size = 64;

void seal(const fs::path& object) {
    const std::string digest = sha256_of_file(object);
    std::ofstream(object, std::ios::binary | std::ios::app) << digest;
}

bool is_sealed(const fs::path& object) {
    const std::string content = read_text(object);
    if (content.size() < seal_size) return false;
    const std::size_t end = content.size() - seal_size;
    return sha256(std::string_view(content).substr(0, end)) == content.substr(end);
}

void build(const std::string& text, const std::string& toolchain, const fs::path& target,
           const CacheOptions& options) {
    const WorkFolder work(target.parent_path());
    const fs::path source = work.path() / "simulator.cpp", object = work.path() / "simulator.so";
    std::ofstream(source, std::ios::binary) << text;
    const auto prepared = prepared_runtime(target.parent_path(), toolchain);
    if (is_interrupted()) throw Failure("interrupted while compiling", "", interrupted);
    Diagnostics diagnostics;
    bool built = false;
    try {
        built = build_shared_object(source, object, Processors::LikeThis, options.extern_headers,
                                    diagnostics, prepared);
    } catch (const std::logic_error&) {
        // Ctrl-C reaches the compiler, too.
        if (is_interrupted()) throw Failure("interrupted while compiling", "", interrupted);
        throw;
    }
    if (!built) {
        if (is_interrupted()) throw Failure("interrupted while compiling", "", interrupted);
        fmt::print(stderr, "{}", render(diagnostics, {}, {}));
        if (!options.extern_headers.empty()) throw Diagnosed{};
        throw Failure("the simulator cannot be compiled", "--engine=interpreter needs no compiler");
    }
    seal(object);
    fs::rename(object, target);
}

}  // namespace

fs::path cache_folder() {
    if (const char* const cache = std::getenv("XDG_CACHE_HOME"); cache && *cache == '/')
        return fs::path(cache) / "rddlc";
    if (const char* const home = std::getenv("HOME"); home && *home)
        return fs::path(home) / ".cache" / "rddlc";
    throw Failure(
        "there is no place for compiled simulators: neither XDG_CACHE_HOME nor HOME is set");
}

CachedObject cached_object(const std::string& text, const CacheOptions& options) {
    const std::string toolchain = toolchain_text();
    const fs::path target = cache_folder() / (content_key(text, toolchain, options) + ".so");
    if (!options.ignore_cache && is_sealed(target)) return {target, std::nullopt};
    const CompilingMessage message(options.what, !options.quiet);
    build(text, toolchain, target, options);
    return {target, message.done()};
}

}  // namespace rddlc::cli
