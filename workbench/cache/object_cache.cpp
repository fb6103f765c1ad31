#include "cache/object_cache.hpp"

#include "cache/cache_folder.hpp"
#include "cache/prepared_runtime.hpp"
#include "cache/sealed_files.hpp"
#include "driver/extern_headers.hpp"
#include "driver/shared_object.hpp"
#include "driver/work_folder.hpp"
#include "support/failure.hpp"
#include "support/files.hpp"
#include "support/program.hpp"
#include "support/render.hpp"
#include "support/sha256.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/progress.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace rddlc::workbench {

namespace fs = std::filesystem;

namespace {

// The user's headers with what they include.
std::string extern_text(const std::vector<fs::path>& headers) {
    std::string text;
    for (const fs::path& file : with_included_files(headers))
        text += file.string() + '\0' + read_file(file) + '\0';
    return text;
}

// Everything that the compiled code depends on.
std::string content_key(const std::string& text, const std::string& toolchain,
                        const CacheOptions& options) {
    return sha256(fmt::format("{}\n{}\n{}", text, toolchain, extern_text(options.extern_headers)));
}

// Reports on a terminal what takes so long.
class CompilingMessage {
  public:
    CompilingMessage(const std::string& problem, bool shown) : shown_(shown && tells_to_screen()) {
        if (shown_) tell("compiling {} ...", problem);
    }
    // The seconds that it took.
    double done() const {
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin_;
        if (shown_) tell(" ({})\n", duration_text(elapsed.count()));
        return elapsed.count();
    }

  private:
    bool shown_;
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

void build(const std::string& text, const std::string& toolchain, const fs::path& target,
           const CacheOptions& options) {
    const WorkFolder work(target.parent_path(), "building-",
                          "set XDG_CACHE_HOME to a folder that can be written");
    const fs::path source = work.path() / "simulator.cpp", object = work.path() / "simulator.so";
    UsedFiles used;
    write_file(source, text, used);
    std::optional<fs::path> prepared;
    if (const auto real = options.linked_batches)
        prepared = prepared_runtime(target.parent_path(), toolchain, *real);
    give_up_if_interrupted();
    Diagnostics diagnostics;
    bool built = false;
    try {
        built = build_shared_object(source, object, Processors::LikeThis, options.extern_headers,
                                    diagnostics, prepared);
    } catch (const std::logic_error&) {
        // Ctrl-C also reaches the compiler.
        give_up_if_interrupted();
        throw;
    }
    if (!built) {
        give_up_if_interrupted();
        tell_with_codes(render(diagnostics, {}, {}));
        tell(closing_lines(diagnostics, "rddl"));
        if (!options.extern_headers.empty()) throw Diagnosed{};
        throw Failure("the simulator cannot be compiled", "--engine=interpreter needs no compiler");
    }
    seal(object);
    fs::rename(object, target);
}

}  // namespace

CachedObject cached_object(const std::string& text, const CacheOptions& options) {
    if (const auto complaint = complaint_about_environment()) throw Failure(*complaint);
    const std::string toolchain = toolchain_text();
    give_up_if_interrupted();
    const fs::path target = cache_folder() / (content_key(text, toolchain, options) + ".so");
    if (!options.ignore_cache && is_sealed(target)) return {target, std::nullopt};
    const CompilingMessage message(options.what, !options.quiet);
    build(text, toolchain, target, options);
    return {target, message.done()};
}

}  // namespace rddlc::workbench
