#include "object_cache.hpp"

#include "driver/extern_headers.hpp"
#include "driver/process.hpp"
#include "driver/shared_object.hpp"
#include "failure.hpp"
#include "interrupt.hpp"
#include "progress.hpp"
#include "read_text.hpp"
#include "sha256.hpp"
#include "support/render.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace rddlc::cli {

namespace fs = std::filesystem;

namespace {

// All headers of the runtime, by name; empty if there are none.
std::string runtime_text() {
    const auto folder = runtime_include_folder();
    if (!folder) return {};
    std::vector<fs::path> headers;
    for (const auto& entry : fs::recursive_directory_iterator(*folder / "rddl"))
        if (entry.is_regular_file()) headers.push_back(entry.path());
    std::sort(headers.begin(), headers.end());
    std::string text;
    for (const fs::path& header : headers)
        text += header.lexically_relative(*folder).string() + '\0' + read_text(header) + '\0';
    return text;
}

// What the compiler of a command says about itself: the words before its options are asked.
std::string compiler_version(const std::vector<std::string>& command) {
    const auto is_option = [](const std::string& word) {
        return word.starts_with('-');
    };
    const auto end = std::find_if(command.begin(), command.end(), is_option);
    std::vector<std::string> question(command.begin(), end);
    question.emplace_back("--version");
    const auto answer = run_process(question);
    return answer ? answer->output : "";
}

// The user's headers with what they include.
std::string extern_text(const std::vector<fs::path>& headers) {
    std::string text;
    for (const fs::path& file : with_included_files(headers))
        text += file.string() + '\0' + read_text(file) + '\0';
    return text;
}

// Everything that the compiled code depends on.
std::string content_key(const std::string& text, const CacheOptions& options) {
    const auto command =
        shared_object_command("simulator.cpp", "simulator.so", Processors::LikeThis);
    return sha256(fmt::format("{}\n{}\n{}\n{}\n{}", text, runtime_text(),
                              extern_text(options.extern_headers), fmt::join(command, " "),
                              compiler_version(command)));
}

// A folder of our own beside the final place, so that a rename is atomic; removed at the end.
class WorkFolder {
  public:
    explicit WorkFolder(const fs::path& parent) {
        std::error_code error;
        fs::create_directories(parent, error);
        std::string pattern = (parent / "building-XXXXXX").string();
        if (!mkdtemp(pattern.data()))
            throw Failure(
                fmt::format("cannot write to '{}': {}", parent.string(), std::strerror(errno)),
                "set XDG_CACHE_HOME to a folder that can be written");
        path_ = pattern;
    }
    ~WorkFolder() {
        std::error_code error;
        fs::remove_all(path_, error);
    }
    WorkFolder(const WorkFolder&) = delete;
    WorkFolder& operator=(const WorkFolder&) = delete;

    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

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

// What all simulators link, made on the first use; nothing if it cannot be made.
std::optional<fs::path> cached_batches() {
    const auto command = batches_command("batches.o");
    const std::string key = sha256(fmt::format("{}\n{}\n{}", runtime_text(),
                                               fmt::join(command, " "), compiler_version(command)));
    const fs::path target = cache_folder() / (key + ".o");
    if (fs::exists(target)) return target;
    const WorkFolder work(target.parent_path());
    const fs::path object = work.path() / "batches.o";
    const auto result = run_process(batches_command(object));
    if (!result || result->status != 0) return std::nullopt;
    fs::rename(object, target);
    return target;
}

void build(const std::string& text, const fs::path& target, const CacheOptions& options) {
    const WorkFolder work(target.parent_path());
    const fs::path source = work.path() / "simulator.cpp", object = work.path() / "simulator.so";
    std::ofstream(source, std::ios::binary) << text;
    const auto batches = cached_batches();
    if (is_interrupted()) throw Failure("interrupted while compiling", "", interrupted);
    Diagnostics diagnostics;
    bool built = false;
    try {
        built = build_shared_object(source, object, Processors::LikeThis, options.extern_headers,
                                    diagnostics, batches);
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
    const fs::path target = cache_folder() / (content_key(text, options) + ".so");
    if (!options.ignore_cache && is_sealed(target)) return {target, std::nullopt};
    const CompilingMessage message(options.what, !options.quiet);
    build(text, target, options);
    return {target, message.done()};
}

}  // namespace rddlc::cli
