#include "cxx_compiler.hpp"

#include "failure.hpp"
#include "interrupt.hpp"
#include "process.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <sstream>

namespace rddlc::cli {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> words_of(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

std::optional<CxxCompiler> try_compiler(const std::string& command) {
    CxxCompiler compiler{words_of(command), {}};
    std::vector<std::string> question = compiler.command;
    question.emplace_back("--version");
    ProcessResult answer = run_process(question);
    if (answer.status != 0) return std::nullopt;
    compiler.version = std::move(answer.output);
    return compiler;
}

}  // namespace

std::optional<CxxCompiler> find_cxx_compiler() {
    if (const char* const chosen = std::getenv("CXX"); chosen && *chosen) {
        if (auto compiler = try_compiler(chosen)) return compiler;
        throw Failure(fmt::format("CXX is '{}', which does not run", chosen),
                      "--engine=interpreter needs no compiler");
    }
    for (const char* const name : {"c++", "g++", "clang++"})
        if (auto compiler = try_compiler(name)) return compiler;
    return std::nullopt;
}

fs::path runtime_folder() {
    if (const char* const chosen = std::getenv("RDDLC_RUNTIME"); chosen && *chosen) return chosen;
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    const fs::path installed = program.parent_path().parent_path() / "include";
    if (!error && fs::exists(installed / "rddl/simulator.hpp")) return installed;
    return RDDLC_RUNTIME_FOLDER;
}

std::vector<std::string> simulator_flags() {
    // Without contraction the result is the interpreter's, bit for bit.
    return {"-std=c++20",
            "-O2",
            "-ffp-contract=off",
            "-shared",
            "-fPIC",
            "-w",
            "-DRDDL_ENTRY=rddl_simulator_entry"};
}

void compile_simulator(const CxxCompiler& compiler, const fs::path& source,
                       const fs::path& shared_object) {
    std::vector<std::string> words = compiler.command;
    for (const std::string& flag : simulator_flags()) words.push_back(flag);
    words.push_back("-I" + runtime_folder().string());
    words.push_back(source.string());
    words.insert(words.end(), {"-o", shared_object.string()});
    const ProcessResult result = run_process(words);
    if (is_interrupted()) throw Failure("interrupted while compiling", "", interrupted);
    if (result.status != 0)
        throw Failure(fmt::format("the C++ compiler failed with status {}:\n{}\n{}", result.status,
                                  fmt::join(words, " "), result.output),
                      "--engine=interpreter needs no compiler");
}

}  // namespace rddlc::cli
