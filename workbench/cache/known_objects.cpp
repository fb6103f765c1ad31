#include "cache/known_objects.hpp"

#include "cache/cache_folder.hpp"
#include "cache/sealed_files.hpp"
#include "driver/cpp_compiler.hpp"
#include "driver/shared_object.hpp"
#include "support/failure.hpp"
#include "support/files.hpp"
#include "support/sha256.hpp"

#include <rddl/lanes/processor.hpp>

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <utility>
#include <vector>

namespace rddlc::workbench {

namespace fs = std::filesystem;

namespace {

// Changes when the file does.
std::string identity_of(const fs::path& file) {
    return fmt::format("{} {} {}\n", file.string(), fs::file_size(file),
                       fs::last_write_time(file).time_since_epoch().count());
}

// The program or library that this code is part of.
fs::path this_compiler() {
    Dl_info place;
    const bool found = ::dladdr(reinterpret_cast<const void*>(&this_compiler), &place) != 0;
    const fs::path file = found ? place.dli_fname : "";
    return fs::exists(file) ? file : fs::path("/proc/self/exe");
}

std::string runtime_identity() {
    const auto folder = runtime_include_folder();
    std::vector<std::string> lines;
    if (folder)
        for (const auto& entry : fs::recursive_directory_iterator(*folder / "rddl"))
            if (entry.is_regular_file()) lines.push_back(identity_of(entry.path()));
    std::sort(lines.begin(), lines.end());
    return fmt::format("{}", fmt::join(lines, ""));
}

std::string value_of(const char* variable) {
    const char* const value = std::getenv(variable);
    return value ? value : "";
}

// Finds a program on PATH, behind all links.
std::optional<fs::path> find_program(const std::string& name) {
    std::error_code missing;
    if (name.find('/') != std::string::npos) {
        fs::path file = fs::canonical(name, missing);
        return missing ? std::nullopt : std::optional(std::move(file));
    }
    std::istringstream folders(value_of("PATH"));
    for (std::string folder; std::getline(folders, folder, ':');) {
        const fs::path file = fs::canonical(fs::path(folder) / name, missing);
        if (!missing) return file;
    }
    return std::nullopt;
}

fs::path file_of(const std::string& key) {
    return cache_folder() / (key + ".known");
}

}  // namespace

bool is_compiler_there() {
    return find_program(cpp_compiler().front()).has_value();
}

std::optional<std::string> key_of_files(const std::vector<fs::path>& files,
                                        const std::string& options) {
    try {
        const std::vector<std::string> command = cpp_compiler();
        const auto compiler = find_program(command.front());
        if (!compiler) return std::nullopt;
        std::string text =
            fmt::format("{}\n{} {}\n{}\n", options,
                        static_cast<int>(rddl::allowed_instruction_set()),
                        rddl::processor_permutes_bytes(), fmt::join(command, " "));
        text += identity_of(*compiler) + identity_of(this_compiler()) + runtime_identity();
        for (const fs::path& file : files) text += file.string() + '\0' + read_file(file) + '\0';
        return sha256(text);
    } catch (const Failure&) {
        return std::nullopt;  // the compilation reports the error
    } catch (const fs::filesystem_error&) {
        return std::nullopt;
    }
}

std::optional<fs::path> known_object(const std::string& key) {
    const fs::path file = file_of(key);
    if (!is_ours(file)) return std::nullopt;
    const fs::path object = cache_folder() / fs::path(read_file(file)).filename();
    return object.extension() == ".so" && is_sealed(object) ? std::optional(object) : std::nullopt;
}

void remember_object(const std::string& key, const fs::path& object) {
    UsedFiles used;
    write_file(file_of(key), object.filename().string(), used);
}

}  // namespace rddlc::workbench
