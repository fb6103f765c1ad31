#include "driver/compiler_failure.hpp"

#include "driver/codes.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string_view>

namespace rddlc {
namespace {

constexpr const char* digits = "0123456789";

// "file:12:5: error: ..." and "file:12: error: ...", but not "collect2: error: ...", nor "fatal
// error": that a file is missing or cannot be written.
bool names_a_place(std::string_view line) {
    const std::size_t end = line.find(": error: ");
    if (end == line.npos) return false;
    const std::size_t before = line.substr(0, end).find_last_not_of(digits);
    return before != line.npos && before + 1 < end && line[before] == ':';
}

// Messages of the system and compilers about missing resources, and hints that help.
struct Lack {
    const char* phrase;
    const char* hint;
};
constexpr const char* more_room = "make room on the disk, or set TMPDIR to a folder that has some";
constexpr const char* more_memory =
    "the C++ compiler needs more memory: end other programs, or "
    "raise its limit";
constexpr Lack lacks[] = {{"No space left on device", more_room},
                          {"Disk quota exceeded", more_room},
                          {"File too large", more_room},
                          {"File size limit exceeded", more_room},
                          {"Read-only file system", more_room},
                          {"Cannot create temporary file", more_room},
                          {"out of memory", more_memory},
                          {"Out of memory", more_memory},
                          {"memory exhausted", more_memory},
                          {"Cannot allocate memory", more_memory},
                          {"bad_alloc", more_memory},
                          {"Killed signal", more_memory},
                          {"Resource temporarily unavailable", more_memory}};

const Lack* lack_of(const ProcessResult& failed) {
    for (const Lack& lack : lacks)
        if (failed.output.find(lack.phrase) != std::string::npos) return &lack;
    return nullptr;
}

const char* options_of_user() {
    const char* const compiler = std::getenv("CXX");
    return compiler && std::strstr(compiler, " -") ? compiler : nullptr;
}

std::string hint_for(const ProcessResult& failed) {
    if (const Lack* const lack = lack_of(failed)) return lack->hint;
    if (const char* const words = options_of_user())
        return fmt::format("leave the options out of CXX, which is '{}'", words);
    return "set CXX to g++ 12, clang++ 14 or a newer one";
}

}  // namespace

bool names_a_mistake(const ProcessResult& failed) {
    std::istringstream lines(failed.output);
    for (std::string line; std::getline(lines, line);)
        if (names_a_place(line) || line.find("undefined reference") != line.npos) return true;
    return false;
}

bool lacks_resources(const ProcessResult& failed) {
    return failed.was_killed() || lack_of(failed) != nullptr;
}

bool is_our_mistake(const ProcessResult& failed, const std::function<bool()>& compiles_runtime) {
    return names_a_mistake(failed) && !lacks_resources(failed) && !options_of_user() &&
           compiles_runtime();
}

Diagnostic failing_compiler(const std::vector<std::string>& command, const ProcessResult& failed) {
    constexpr int most_lines = 20;
    const std::string end = !failed.was_killed()
                                ? fmt::format("ends with status {}", failed.status)
                                : fmt::format("is ended by signal {}", failed.status - 128);
    Diagnostic diagnostic{.code = broken_cpp_compiler,
                          .span = {},
                          .message = fmt::format("the C++ compiler '{}' {}", command.front(), end)};
    std::istringstream lines(failed.output);
    std::string line;
    for (int i = 0; i < most_lines && std::getline(lines, line); ++i)
        diagnostic.notes.push_back({{}, line});
    return std::move(diagnostic).with_hint(hint_for(failed));
}

Diagnostic idle_compiler(const std::vector<std::string>& command) {
    return Diagnostic{
        .code = broken_cpp_compiler,
        .span = {},
        .message = fmt::format("the C++ compiler '{}' ends with status 0, but made no output",
                               command.front())}
        .with_hint("set CXX to g++ 12, clang++ 14 or a newer one");
}

}  // namespace rddlc
