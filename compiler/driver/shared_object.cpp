#include "driver/shared_object.hpp"

#include "driver/codes.hpp"
#include "driver/compiler_failure.hpp"
#include "driver/cpp_compiler.hpp"
#include "driver/process.hpp"
#include "ir/lane_count.hpp"
#include "support/files.hpp"

#include <rddl/lanes/processor.hpp>

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <future>
#include <sstream>
#include <stdexcept>

namespace rddlc {
namespace {

namespace fs = std::filesystem;

bool holds_runtime(const fs::path& folder) {
    return is_there(folder / "rddl" / "simulator.hpp");
}

// Empty if it is not set.
std::string environment_value(const char* name) {
    const char* const value = std::getenv(name);
    return value ? value : "";
}

// Some compilers say that all went well, and made nothing.
bool is_filled(const fs::path& file) {
    std::error_code missing;
    return fs::file_size(file, missing) > 0 && !missing;
}

// The flags for the greatest level of x86-64 that this machine's processor has, and for what it has
// beyond the greatest one; none if it is another processor.
std::vector<std::string> processor_flags() {
#ifdef __x86_64__
    switch (rddl::allowed_instruction_set()) {
        case rddl::InstructionSet::Sse2:
            return {"-march=x86-64"};
        case rddl::InstructionSet::Avx2:
            return {"-march=x86-64-v3"};
        case rddl::InstructionSet::Avx512:
            if (!rddl::processor_permutes_bytes()) return {"-march=x86-64-v4"};
            return {"-march=x86-64-v4", "-mavx512vbmi", "-mavx512vpopcntdq", "-mgfni"};
    }
#endif
    return {};
}

// The diagnostic with the beginning of the compiler's messages.
Diagnostic refused(const std::vector<fs::path>& extern_headers, const std::string& output) {
    constexpr int most_lines = 30;
    std::vector<std::string> names;
    for (const fs::path& header : extern_headers) names.push_back("'" + header.string() + "'");
    Diagnostic diagnostic{
        .code = refused_external,
        .span = {},
        .message = fmt::format("the C++ compiler refuses {}", fmt::join(names, ", "))};
    std::istringstream lines(output);
    std::string line;
    for (int i = 0; i < most_lines && std::getline(lines, line); ++i) {
        diagnostic.notes.push_back({{}, line});
    }
    return diagnostic;
}

// The messages are in English, so that they can be parsed.
std::optional<ProcessResult> run_compiler(const std::vector<std::string>& command,
                                          const std::stop_token& stop = {}) {
    return run_process(command, {"LC_ALL=C"}, {}, stop);
}

// Runs beside this thread if the system has another one, else when the result is asked for. The
// command is copied: if no thread starts, libstdc++ 12 moves from its arguments a second time.
std::future<std::optional<ProcessResult>> start_compiler(const std::vector<std::string>& command,
                                                         const std::stop_token& stop = {}) {
    return std::async(run_compiler, command, stop);
}

// The compiler and the common options of all its calls. Hidden functions are called without a
// detour through a table of the linker.
std::vector<std::string> compiler_command(Processors processors, const std::stop_token& stop = {}) {
    std::vector<std::string> command = cpp_compiler();
    const std::vector<std::string> flags = simulator_flags(command, stop);
    command.insert(command.end(), {"-std=c++20", "-fPIC", "-fvisibility=hidden"});
    command.insert(command.end(), flags.begin(), flags.end());
    if (processors == Processors::LikeThis) {
        const std::vector<std::string> own = processor_flags();
        command.insert(command.end(), own.begin(), own.end());
    }
    if (const auto folder = runtime_include_folder()) command.push_back("-I" + folder->string());
    return command;
}

// An interrupted compiler has not refused the text.
bool is_refused(const std::optional<ProcessResult>& result) {
    return result && result->status != 0 && !result->was_killed();
}

// Names within a folder of prepared files. Compilers look for the third when they are told to
// include the second, which replaces it if they do not accept it.
constexpr const char* batches_name = "batches.o";
constexpr const char* header_name = "simulator.hpp";
constexpr const char* precompiled_name = "simulator.hpp.gch";

std::vector<std::string> batches_command(const fs::path& source, const fs::path& output,
                                         RealType real) {
    std::vector<std::string> command = compiler_command(Processors::LikeThis);
    command.insert(command.end(), {fmt::format("-DRDDL_BATCHES_OF={}", name_of(real)), "-c", "-o",
                                   output.string(), source.string()});
    return command;
}

std::vector<std::string> header_command(const fs::path& source, const fs::path& output) {
    std::vector<std::string> command = compiler_command(Processors::LikeThis);
    command.insert(command.end(), {"-DRDDL_LINKS_BATCHES", "-x", "c++-header", "-o",
                                   output.string(), source.string()});
    return command;
}

bool succeeds(const std::optional<ProcessResult>& result) {
    return result && result->status == 0;
}

// Compiles with the prepared files, which saves most of the time; without them if the compiler
// refuses one. The user's headers come before those of the runtime, so that these are not prepared.
std::optional<ProcessResult> compile(const std::vector<std::string>& command,
                                     const std::optional<fs::path>& prepared,
                                     bool has_extern_headers, const std::stop_token& stop) {
    if (!prepared) return run_compiler(command, stop);
    std::vector<std::string> linking = command;
    linking.insert(linking.end(), {"-DRDDL_LINKS_BATCHES", (*prepared / batches_name).string()});
    std::error_code ignored;
    if (!has_extern_headers && fs::exists(*prepared / precompiled_name, ignored)) {
        std::vector<std::string> including = linking;
        including.insert(including.end(), {"-include", (*prepared / header_name).string()});
        auto result = run_compiler(including, stop);
        if (!is_refused(result)) return result;
        fs::remove(*prepared / precompiled_name, ignored);
    }
    auto result = run_compiler(linking, stop);
    return is_refused(result) ? run_compiler(command, stop) : result;
}

#ifdef __x86_64__

// One object of a simulator for several instruction sets.
struct Part {
    const char* name;
    const char* level;
    const char* entry;  // null: that of the dispatcher, which chooses between the others
};

// Lower ones first (rddl/interface/dispatch.cpp says why).
constexpr Part parts[] = {{"dispatch", "x86-64", nullptr},
                          {"sse2", "x86-64", "rddl_simulator_sse2"},
                          {"avx2", "x86-64-v3", "rddl_simulator_avx2"},
                          {"avx512", "x86-64-v4", "rddl_simulator_avx512"}};

std::vector<std::string> part_command(const Part& part, const fs::path& source,
                                      const fs::path& object) {
    std::vector<std::string> command = compiler_command(Processors::Any);
    const fs::path dispatcher =
        runtime_include_folder().value_or("") / "rddl" / "interface" / "dispatch.cpp";
    command.insert(command.end(), {"-march=" + std::string(part.level), "-c", "-o", object.string(),
                                   part.entry ? source.string() : dispatcher.string()});
    if (part.entry) {
        command.push_back("-DRDDL_ENTRY=" + std::string(part.entry));
        command.push_back("-DRDDL_EXPORT=");
    }
    return command;
}

// Compiles for every instruction set, at once, and links. A non-zero result is the status of one of
// the compilers.
std::optional<ProcessResult> compile_all_sets(const fs::path& source, const fs::path& output) {
    std::vector<std::future<std::optional<ProcessResult>>> running;
    std::vector<std::string> linking = compiler_command(Processors::Any);
    linking.insert(linking.end(), {"-shared", "-o", output.string()});
    std::vector<fs::path> objects;
    for (const Part& part : parts) {
        objects.push_back(output.string() + "." + part.name + ".o");
        linking.push_back(objects.back().string());
        running.push_back(start_compiler(part_command(part, source, objects.back())));
    }
    std::optional<ProcessResult> result = ProcessResult{};
    for (auto& one : running) {
        auto its_result = one.get();
        if (result && result->status == 0) result = std::move(its_result);
    }
    if (result && result->status == 0) result = run_compiler(linking);
    std::error_code ignored;
    for (const fs::path& object : objects) fs::remove(object, ignored);
    return result;
}

#endif

// Compiles for any processor; if the compiler refuses the instruction sets of x86-64, for its
// default target.
std::optional<ProcessResult> compile_for_any(const fs::path& source, const fs::path& output) {
#ifdef __x86_64__
    auto result = compile_all_sets(source, output);
    if (result && !is_refused(result)) return result;
#endif
    return run_compiler(shared_object_command(source, output, Processors::Any));
}

// Nothing but the headers of the runtime, beside the output.
bool compiles_headers(const fs::path& output, Processors processors) {
    const fs::path source = output.string() + ".headers.cpp", object = output.string() + ".headers";
    UsedFiles used;
    write_file(source, "#include <rddl/simulator.hpp>\n", used);
    const bool done = succeeds(run_compiler(shared_object_command(source, object, processors)));
    for (const fs::path& file : {source, object}) {
        std::error_code ignored;
        fs::remove(file, ignored);
    }
    return done;
}

// The diagnostic if the compiler is missing, or the system starts no more processes.
Diagnostic not_started(const std::string& compiler, int error) {
    const bool is_missing = error == ENOENT || error == EACCES || error == ENOTDIR;
    return Diagnostic{.code = no_cpp_compiler,
                      .span = {},
                      .message = fmt::format("cannot run the C++ compiler '{}': {}", compiler,
                                             std::strerror(error))}
        .with_hint(is_missing ? "a shared object needs one: install it, or set CXX"
                              : "there are too many processes or open files, or too little memory");
}

}  // namespace

std::optional<fs::path> runtime_include_folder() {
    std::vector<fs::path> candidates;
    if (const char* folder = std::getenv("RDDLC_INCLUDE")) candidates.push_back(folder);
    std::error_code ignored;
    const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
    if (!program.empty()) candidates.push_back(program.parent_path() / RDDLC_INCLUDE_FROM_BIN);
    Dl_info library;  // that this code is part of, in place of a program
    if (::dladdr(reinterpret_cast<const void*>(&runtime_include_folder), &library) != 0)
        candidates.push_back(fs::path(library.dli_fname).parent_path() / "include");
    candidates.push_back(RDDLC_SOURCE_INCLUDE);
    for (const fs::path& candidate : candidates) {
        if (holds_runtime(candidate)) return candidate.lexically_normal();
    }
    return std::nullopt;
}

std::optional<std::string> complaint_about_environment() {
    const std::string include = environment_value("RDDLC_INCLUDE");
    if (!include.empty() && !holds_runtime(include))
        return fmt::format("RDDLC_INCLUDE is '{}', which holds no rddl/simulator.hpp", include);
    const std::string set = environment_value("RDDL_INSTRUCTION_SET");
    if (!set.empty() && set != "sse2" && set != "avx2" && set != "avx512")
        return fmt::format(
            "RDDL_INSTRUCTION_SET is '{}', which is not one of sse2, avx2 and avx512", set);
    return std::nullopt;
}

std::vector<std::string> shared_object_command(const fs::path& source, const fs::path& output,
                                               Processors processors, const std::stop_token& stop) {
    std::vector<std::string> command = compiler_command(processors, stop);
    command.insert(command.end(), {"-shared", "-DRDDL_ENTRY=rddl_simulator_entry", "-o",
                                   output.string(), source.string()});
    return command;
}

bool prepare_runtime(const fs::path& folder, RealType real, const std::stop_token& stop) {
    const fs::path runtime = runtime_include_folder().value_or("") / "rddl";
    auto header =
        start_compiler(header_command(runtime / "simulator.hpp", folder / precompiled_name), stop);
    const auto batches =
        run_compiler(batches_command(runtime / "batches.cpp", folder / batches_name, real), stop);
    UsedFiles used;
    write_file(folder / header_name, "#include <rddl/simulator.hpp>\n", used);
    const auto header_result = header.get();
    if (is_refused(header_result) && !lacks_resources(*header_result)) {
        std::error_code ignored;
        fs::remove(folder / precompiled_name, ignored);
        return succeeds(batches) && is_filled(folder / batches_name);
    }
    return succeeds(batches) && is_filled(folder / batches_name) && succeeds(header_result);
}

bool has_prepared_batches(std::optional<int> lane_count) {
    return !lane_count || *lane_count == 1 ||
           std::ranges::count(ir::suitable_lane_counts, *lane_count) > 0;
}

bool build_shared_object(const fs::path& source, const fs::path& output, Processors processors,
                         const std::vector<fs::path>& extern_headers, Diagnostics& diagnostics,
                         const std::optional<fs::path>& prepared, const std::stop_token& stop) {
    if (const auto complaint = complaint_about_environment()) {
        diagnostics.report({no_cpp_compiler, {}, *complaint});
        return false;
    }
    if (!runtime_include_folder()) {
        diagnostics.report(Diagnostic{.code = no_cpp_compiler,
                                      .span = {},
                                      .message = "cannot find the headers of the runtime"}
                               .with_hint("set RDDLC_INCLUDE to the folder that holds "
                                          "rddl/simulator.hpp"));
        return false;
    }
    const std::vector<std::string> command = shared_object_command(source, output, processors);
    const auto result = processors == Processors::Any
                            ? compile_for_any(source, output)
                            : compile(command, prepared, !extern_headers.empty(), stop);
    if (!result) {
        diagnostics.report(not_started(command.front(), errno));
        return false;
    }
    if (result->status == 0 && is_filled(output)) return true;
    if (result->status == 0) {
        diagnostics.report(idle_compiler(command));
        return false;
    }
    if (!extern_headers.empty() && names_a_mistake(*result)) {
        diagnostics.report(refused(extern_headers, result->output));
        return false;
    }
    const auto compiles_runtime = [&] {
        return compiles_headers(output, processors);
    };
    if (is_our_mistake(*result, compiles_runtime))
        throw std::logic_error(fmt::format("the C++ compiler refuses the emitted text ({}):\n{}",
                                           fmt::join(command, " "), result->output));
    diagnostics.report(failing_compiler(command, *result));
    return false;
}

}  // namespace rddlc
