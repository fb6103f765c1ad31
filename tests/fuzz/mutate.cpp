// Fuzzing without clang: a fixed sequence of damaged problems.
//
//   fuzz_mutations [--count N] [--seed S] [--words FILE] FOLDER...
//       damages the problems found there
//   fuzz_mutations --write-seeds CORPUS FOLDER...
//       writes them for libFuzzer
//   fuzz_mutations --steps N FILE...
//       exercises one problem as it is
//
// The text under way is in fuzz-input.rddl, which stays there if the compiler crashes, contradicts
// itself or takes longer than 20 seconds of the processor.
#include "exercise.hpp"
#include "mutator.hpp"
#include "under_way.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace rddlc::fuzzing {
namespace {

namespace fs = std::filesystem;

constexpr const char* input_under_way = "fuzz-input.rddl";
constexpr std::size_t longest_seed = 20'000;  // bytes; the time for longer ones is better spent

struct Options {
    std::vector<fs::path> paths;
    int count = 5000;
    std::uint64_t seed = 1;
    int steps = 4;
    std::string words;
    std::string corpus;
};

std::string read(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

void write(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

// A problem is the files of one folder: domain.rddl comes before instance.rddl.
std::vector<std::string> problems_in(const std::vector<fs::path>& folders) {
    std::map<fs::path, std::vector<fs::path>> files;
    for (const fs::path& folder : folders) {
        for (const auto& entry : fs::recursive_directory_iterator(folder)) {
            if (entry.path().extension() == ".rddl") {
                files[entry.path().parent_path()].push_back(entry.path());
            }
        }
    }
    std::vector<std::string> problems;
    for (auto& [folder, paths] : files) {
        std::ranges::sort(paths);
        std::string text;
        for (const fs::path& path : paths) text += read(path);
        if (text.size() <= longest_seed) problems.push_back(std::move(text));
    }
    return problems;
}

// The words of a libFuzzer dictionary: one "..." a line.
std::vector<std::string> words_in(const std::string& file) {
    std::vector<std::string> words;
    std::ifstream lines(file);
    for (std::string line; std::getline(lines, line);) {
        if (line.size() > 2 && line[0] == '"') words.push_back(line.substr(1, line.size() - 2));
    }
    return words;
}

Outcome outcome_of(const std::string& text, std::uint64_t seed, int steps) {
    return guarded(input_under_way, text, [&] { return exercise(text, seed, steps); });
}

void report(const std::array<int, 3>& outcomes) {
    fmt::print("{} rejected, {} accepted, {} too large to run\n", outcomes[0], outcomes[1],
               outcomes[2]);
}

void mutate(const Options& options, const std::vector<std::string>& seeds) {
    Mutator mutator(seeds, words_in(options.words), options.seed);
    std::array<int, 3> outcomes{};
    const auto count = [&](Outcome outcome) {
        ++outcomes[static_cast<std::size_t>(outcome)];
    };
    for (const std::string& seed : seeds) count(outcome_of(seed, 1, options.steps));
    for (int i = 0; i < options.count; ++i) {
        count(outcome_of(mutator.next(), static_cast<std::uint64_t>(i), options.steps));
    }
    report(outcomes);
}

void run(const Options& options) {
    if (!fs::is_directory(options.paths.front())) {
        std::string text;
        for (const fs::path& path : options.paths) text += read(path);
        exercise(text, options.seed, options.steps);
        return;
    }
    const std::vector<std::string> seeds = problems_in(options.paths);
    if (seeds.empty()) throw std::runtime_error("no problems found");
    if (options.corpus.empty()) return mutate(options, seeds);
    fs::create_directories(options.corpus);
    int number = 0;
    for (const std::string& seed : seeds) {
        write(fs::path(options.corpus) / fmt::format("seed{}.rddl", number++), seed);
    }
}

}  // namespace
}  // namespace rddlc::fuzzing

int main(int argc, char** argv) {
    rddlc::fuzzing::Options options;
    CLI::App app("Exercises the compiler with damaged problems.");
    app.add_option("paths", options.paths, "folders of problems, or the files of one")
        ->required()
        ->check(CLI::ExistingPath);
    app.add_option("--count", options.count, "damaged problems");
    app.add_option("--seed", options.seed, "of the damage");
    app.add_option("--steps", options.steps, "of each problem that is accepted");
    app.add_option("--words", options.words, "dictionary of libFuzzer")->check(CLI::ExistingFile);
    app.add_option("--write-seeds", options.corpus, "only write the problems into this folder");
    CLI11_PARSE(app, argc, argv);
    try {
        rddlc::fuzzing::run(options);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
    return 0;
}
