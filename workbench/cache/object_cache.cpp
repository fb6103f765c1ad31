#include "cache/object_cache.hpp"

#include "cache/builders_turn.hpp"
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

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <thread>
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
    explicit CompilingMessage(const CacheOptions& options)
        : shown_(!options.quiet && !options.on_begin && tells_to_screen()) {
        if (options.on_begin) options.on_begin(options.what);
        if (shown_) tell("compiling {} ...", options.what);
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

// The lock of a file beside the object, which is removed at the end.
class ObjectsTurn {
  public:
    ObjectsTurn(const fs::path& object, const std::stop_token& stop)
        : file_(object.string() + ".lock"), turn_(file_, stop) {}
    ~ObjectsTurn() {
        std::error_code ignored;
        fs::remove(file_, ignored);
    }
    ObjectsTurn(const ObjectsTurn&) = delete;
    ObjectsTurn& operator=(const ObjectsTurn&) = delete;

  private:
    fs::path file_;
    BuildersTurn turn_;
};

// Builds in the background take as many turns as half of the machine has cores.
fs::path background_turn(const fs::path& target) {
    const std::size_t turns = std::max(1U, std::thread::hardware_concurrency() / 2);
    const std::size_t turn = std::hash<std::string>()(target.filename().string()) % turns;
    return target.parent_path() / fmt::format("background-{}.lock", turn);
}

[[noreturn]] void fail_without_a_word(const Diagnostics& diagnostics) {
    for (const Diagnostic& diagnostic : diagnostics.all())
        if (diagnostics.is_error(diagnostic)) throw Failure(diagnostic.message);
    throw Failure("the simulator cannot be compiled");
}

void build(const std::string& text, const std::string& toolchain, const fs::path& target,
           const CacheOptions& options) {
    const WorkFolder work(target.parent_path(), "building-",
                          "set XDG_CACHE_HOME to a folder that can be written");
    const fs::path source = work.path() / "simulator.cpp", object = work.path() / "simulator.so";
    UsedFiles used;
    write_file(source, text, used);
    std::optional<fs::path> prepared;
    if (const auto real = options.linked_batches)
        prepared = prepared_runtime(target.parent_path(), toolchain, *real, options.stop);
    give_up_if_stopped(options.stop);
    Diagnostics diagnostics;
    bool built = false;
    try {
        built = build_shared_object(source, object, Processors::LikeThis, options.extern_headers,
                                    diagnostics, prepared, options.stop);
    } catch (const std::logic_error&) {
        // Ctrl-C also reaches the compiler.
        give_up_if_stopped(options.stop);
        throw;
    }
    if (!built) {
        give_up_if_stopped(options.stop);
        if (options.stop.stop_possible()) fail_without_a_word(diagnostics);
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
    const std::string toolchain = toolchain_text(options.stop);
    give_up_if_interrupted();
    const fs::path target = cache_folder() / (content_key(text, toolchain, options) + ".so");
    const auto is_there = [&] {
        return !options.ignore_cache && is_sealed(target);
    };
    if (is_there()) return {target, std::nullopt};
    const CompilingMessage message(options);
    std::optional<BuildersTurn> background;
    if (options.stop.stop_possible()) background.emplace(background_turn(target), options.stop);
    const ObjectsTurn turn(target, options.stop);
    if (is_there()) {  // by another process
        static_cast<void>(message.done());
        return {target, std::nullopt};
    }
    build(text, toolchain, target, options);
    return {target, message.done()};
}

}  // namespace rddlc::workbench
