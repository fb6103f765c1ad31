// Files that users give beside RDDL, damaged, without clang: a fixed sequence of them.
//
//   fuzz_file_mutations [--count N] [--seed S]
//       damages so many of each kind
//   fuzz_file_mutations --write-seeds CORPUS
//       writes those that are whole for libFuzzer
//   fuzz_file_mutations --input FILE...
//       reads what a fuzzer has left: a letter for the kind, and the file
//
// The input under way is in fuzz-file, which stays there where a reader crashes, throws what it
// must not or takes longer than 20 seconds of the processor.
#include "exercise_file.hpp"
#include "mutator.hpp"
#include "under_way.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace rddlc::fuzzing {
namespace {

namespace fs = std::filesystem;

constexpr const char* input_under_way = "fuzz-file";

struct Options {
    int count = 400;
    std::uint64_t seed = 1;
    std::string corpus;
    std::vector<fs::path> inputs;
};

// Words that readers of JSON, of numbers and of lines stumble over.
std::vector<std::string> words() {
    return {"1e400",
            "-1e400",
            "1e308",
            "3e38",
            "1e-400",
            "-0.0",
            "-1",
            "0",
            "1",
            "1.7",
            "2147483647",
            "2147483648",
            "-2147483648",
            "20000000",
            "9223372036854775807",
            "18446744073709551615",
            "18446744073709551616",
            "null",
            "true",
            "[]",
            "{}",
            "[[",
            "]",
            "{",
            "\"\"",
            "\"nan\"",
            "\"inf\"",
            "nan",
            "\"\\ud800\"",
            "\"\\u0000\"",
            "\"\x1b[31m\"",
            "\"\xc2\x9b\"",
            "\xff",
            "\n",
            std::string(1, '\0'),
            std::string(3000, '['),
            std::string(300, '9')};
}

std::string with_kind(FileKind kind, const std::string& bytes) {
    return static_cast<char>('a' + static_cast<int>(kind)) + bytes;
}

bool is_accepted(FileReaders& readers, FileKind kind, const std::string& bytes) {
    return guarded(input_under_way, with_kind(kind, bytes),
                   [&] { return readers.read(kind, bytes); });
}

// Counts and sizes of a binary file are words of eight bytes.
std::string with_other_bytes(std::string bytes, std::mt19937_64& random) {
    constexpr std::array<std::uint64_t, 8> numbers{
        0, 1, ~0ull, 1ull << 31, 1ull << 32, 1ull << 62, 20'000'000, 0x7ff0ull << 48};
    const auto below = [&](std::size_t bound) {
        return random() % bound;
    };
    for (std::size_t changes = 1 + below(3); changes > 0 && bytes.size() > 8; --changes) {
        const std::size_t at = below(bytes.size() - 8);
        switch (below(4)) {
            case 0:
                bytes[at] = static_cast<char>(below(256));
                break;
            case 1:
                bytes.resize(at);
                break;
            case 2:
                bytes.erase(at, 1 + below(16));
                break;
            default: {
                const std::uint64_t number = numbers[below(numbers.size())];
                bytes.replace(at, sizeof number, reinterpret_cast<const char*>(&number),
                              sizeof number);
            }
        }
    }
    return bytes;
}

void damage(FileReaders& readers, FileKind kind, const Options& options) {
    const std::vector<std::string> examples = readers.examples(kind);
    for (const std::string& example : examples)
        if (!is_accepted(readers, kind, example))
            throw std::runtime_error(
                fmt::format("a whole file of kind {} is refused", with_kind(kind, "")));
    Mutator mutator(examples, words(), options.seed);
    std::mt19937_64 random(options.seed);
    const bool is_binary = kind == FileKind::PpoCheckpoint || kind == FileKind::CgpCheckpoint;
    int accepted = 0;
    for (int i = 0; i < options.count; ++i)
        accepted +=
            is_accepted(readers, kind,
                        is_binary ? with_other_bytes(examples[random() % examples.size()], random)
                                  : mutator.next());
    fmt::print("kind {}: {} of {} accepted\n", with_kind(kind, ""), accepted, options.count);
}

void run(const Options& options) {
    FileReaders readers(RDDL_FUZZED_PROBLEM, RDDL_PLAIN_PROBLEM,
                        fs::current_path() / "fuzzed-files");
    for (const fs::path& input : options.inputs) {
        std::ostringstream text;
        text << std::ifstream(input, std::ios::binary).rdbuf();
        const std::string bytes = text.str();
        if (bytes.empty()) throw std::runtime_error(fmt::format("'{}' is empty", input.string()));
        readers.read(static_cast<FileKind>(bytes[0] - 'a'), std::string_view(bytes).substr(1));
    }
    if (!options.inputs.empty()) return;
    if (!options.corpus.empty()) fs::create_directories(options.corpus);
    for (std::size_t k = 0; k < file_kinds; ++k) {
        const auto kind = static_cast<FileKind>(k);
        if (options.corpus.empty()) {
            damage(readers, kind, options);
            continue;
        }
        int number = 0;
        for (const std::string& example : readers.examples(kind))
            std::ofstream(
                fs::path(options.corpus) / fmt::format("seed{}{}", with_kind(kind, ""), number++),
                std::ios::binary)
                << with_kind(kind, example);
    }
}

}  // namespace
}  // namespace rddlc::fuzzing

int main(int argc, char** argv) {
    rddlc::fuzzing::Options options;
    CLI::App app("Reads damaged files that users give beside RDDL.");
    app.add_option("--count", options.count, "damaged files of each kind");
    app.add_option("--seed", options.seed, "of the damage");
    app.add_option("--write-seeds", options.corpus, "only write whole files into this folder");
    app.add_option("--input", options.inputs, "only read these inputs")->check(CLI::ExistingFile);
    CLI11_PARSE(app, argc, argv);
    try {
        rddlc::fuzzing::run(options);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
    return 0;
}
