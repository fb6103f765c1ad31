#include "cache/prepared_runtime.hpp"

#include "cache/builders_turn.hpp"
#include "cache/sealed_files.hpp"
#include "driver/process.hpp"
#include "driver/shared_object.hpp"
#include "driver/work_folder.hpp"
#include "support/files.hpp"
#include "support/sha256.hpp"
#include "terminal/interrupt.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

namespace rddlc::workbench {

namespace fs = std::filesystem;

namespace {

constexpr const char* runtime_extension = ".runtime";

// All headers of the runtime, by name; empty if there are no headers.
std::string runtime_text() {
    const auto folder = runtime_include_folder();
    if (!folder) return {};
    std::vector<fs::path> headers;
    for (const auto& entry : fs::recursive_directory_iterator(*folder / "rddl"))
        if (entry.is_regular_file()) headers.push_back(entry.path());
    std::sort(headers.begin(), headers.end());
    std::string text;
    for (const fs::path& header : headers)
        text += header.lexically_relative(*folder).string() + '\0' + read_file(header) + '\0';
    return text;
}

// The version text of a command's compiler: its words before the first option are asked.
std::string compiler_version(const std::vector<std::string>& command, const std::stop_token& stop) {
    const auto is_option = [](const std::string& word) {
        return word.starts_with('-');
    };
    const auto end = std::find_if(command.begin(), command.end(), is_option);
    std::vector<std::string> question(command.begin(), end);
    question.emplace_back("--version");
    const auto answer = run_process(question, {}, {}, stop);
    return answer ? answer->output : "";
}

// A precompiled header takes some 60 MB.
void remove_old(const fs::path& cache) {
    constexpr std::size_t kept = 4;
    std::error_code ignored;
    std::vector<std::pair<fs::file_time_type, fs::path>> folders;
    for (const auto& entry : fs::directory_iterator(cache, ignored))
        if (entry.path().extension() == runtime_extension)
            folders.emplace_back(entry.last_write_time(ignored), entry.path());
    std::sort(folders.rbegin(), folders.rend());
    for (std::size_t i = kept; i < folders.size(); ++i) fs::remove_all(folders[i].second, ignored);
}

}  // namespace

std::string toolchain_text(const std::stop_token& stop) {
    const auto command =
        shared_object_command("simulator.cpp", "simulator.so", Processors::LikeThis, stop);
    give_up_if_stopped(stop);
    const std::string version = compiler_version(command, stop);
    give_up_if_stopped(stop);
    return fmt::format("{}\n{}\n{}", runtime_text(), fmt::join(command, " "), version);
}

std::optional<fs::path> prepared_runtime(const fs::path& cache, const std::string& toolchain,
                                         RealType real, const std::stop_token& stop) {
    const fs::path target =
        cache / (sha256(fmt::format("{}\n{}", toolchain, name_of(real))) + runtime_extension);
    if (is_sealed_folder(target)) return target;
    const BuildersTurn turn(cache, stop);
    if (is_sealed_folder(target)) return target;  // by the process that we have waited for
    const WorkFolder work(cache, "building-", "set XDG_CACHE_HOME to a folder that can be written");
    const fs::path made = work.path() / "runtime";
    std::error_code error;
    if (!fs::create_directory(made, error)) throw UnwritableFile(made, error.value());
    if (!prepare_runtime(made, real, stop)) return std::nullopt;
    give_up_if_stopped(stop);
    seal_folder(made);
    std::error_code exists_by_now;
    fs::remove_all(target, exists_by_now);
    fs::rename(made, target, exists_by_now);
    remove_old(cache);
    return target;
}

}  // namespace rddlc::workbench
