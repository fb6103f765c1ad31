#include "solvers/program/program.hpp"

#include "solvers/evaluation/summary.hpp"
#include "solvers/spaces/refusals.hpp"
#include "support/files.hpp"
#include "support/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <limits>
#include <map>

namespace rddlc::solvers {

namespace {

volatile std::sig_atomic_t signalled = 0;  // by which signal

void note_signal(int signal) {
    signalled = signal;
}

void print_options(const std::vector<ProgramOption>& options) {
    for (const ProgramOption& option : options)
        print("  {:<24} {}\n", option.name + (option.value.empty() ? "" : " " + option.value),
              option.help);
}

// Takes the words behind the verb; those that are not "--..." go to `take_other`.
void take_words(int argc, char** argv, const std::vector<ProgramOption>& options,
                const std::function<void(const std::string&)>& take_other) {
    std::map<std::string, std::string> given;
    for (int i = 2; i < argc; ++i) {
        const std::string word = argv[i];
        if (!word.starts_with("--")) {
            take_other(word);
            continue;
        }
        const auto option = std::ranges::find(options, word, &ProgramOption::name);
        if (option == options.end()) {
            throw Failure(unknown_option(word, {options.begin(), options.end()}, Face::CommandLine),
                          {}, usage_error);
        }
        if (option->value.empty()) {
            given[word] = "on";
        } else {
            if (++i == argc) throw Failure(fmt::format("{} needs a value", word), {}, usage_error);
            given[word] = argv[i];
        }
    }
    for (const ProgramOption& option : options) {
        const auto found = given.find(option.name);
        if (found == given.end()) continue;
        try {
            option.set(option.is_list ? words_of_list(found->second) : std::vector{found->second});
        } catch (const OptionRefused& refused) {
            throw Failure(fmt::format("{}: {}", option.name, refused.what()), {}, usage_error);
        }
    }
}

template <class Number, class Target>
ProgramOption number(OptionText text, Target& target, Number least, Number most) {
    return {std::move(text), [&target, least, most](const std::vector<std::string>& words) {
                target = number_of_option<Number>(words.front(), least, most);
            }};
}

constexpr std::uint64_t largest_seed = std::numeric_limits<std::uint64_t>::max();

std::vector<ProgramOption> training_options(TrainingOptions& training) {
    return {
        {{"--out", "", "FOLDER", "Folder of the run's files"},
         [&](const std::vector<std::string>& words) {
             training.folder = words.front();
         }},
        {{"--resume", "", "", "Resume the run in that folder, with the same options"},
         [&](const std::vector<std::string>&) {
             training.resumes = true;
         }},
        number<std::uint64_t>({"--seed", "", "S", "Seed of all random numbers (0)"}, training.seed,
                              0, largest_seed),
        number<double>({"--time", "", "SECONDS", "End after this time"}, training.seconds, 0, 1e9),
        number<double>(
            {"--stop-return", "", "RETURN", "End when an evaluation reaches this return"},
            training.stop_return, -1e300, 1e300)};
}

std::vector<ProgramOption> evaluation_options(EpisodeOptions& episodes) {
    return {number<std::int64_t>({"--episodes", "", "N", "Episodes to run (100)"},
                                 episodes.episodes, 1, 100'000'000),
            number<std::uint64_t>({"--seed", "", "S", "Seed of all random numbers (0)"},
                                  episodes.seed, 0, largest_seed)};
}

void print_help(const char* name, const SolverProgram& program) {
    TrainingOptions training;
    EpisodeOptions episodes;
    print(
        "Usage: {0} train --out FOLDER [OPTIONS]\n       {0} evaluate POLICY [OPTIONS]\n\n"
        "Options of train:\n",
        name);
    print_options(training_options(training));
    print_options(program.options);
    print("\nOptions of evaluate:\n");
    print_options(evaluation_options(episodes));
}

ExitStatus train_by_words(const rddl_simulator& simulator, const SolverProgram& program, int argc,
                          char** argv) {
    TrainingOptions training;
    std::vector<ProgramOption> options = training_options(training);
    options.insert(options.end(), program.options.begin(), program.options.end());
    take_words(argc, argv, options, [](const std::string& word) {
        throw Failure(fmt::format("too many words: '{}'", word), {}, usage_error);
    });
    if (training.folder.empty())
        throw Failure("--out names the folder of the run", {}, usage_error);
    std::signal(SIGINT, note_signal);
    std::signal(SIGTERM, note_signal);
    training.stops = [] {
        return signalled != 0;
    };
    return run_on_ranks(argv[0], training.stops, [&](const Ranks& ranks) {
        training.ranks = ranks;
        const Trainee trainee = program.trainee(simulator, training.seed, ranks);
        const TrainingResult result = train(simulator, trainee, training);
        if (ranks.is_first())
            print("best return {:.6g} in {:.6g} steps: {}\n", result.best_return,
                  result.best_length, training.folder.string());
        if (ranks.is_first() && !result.no_better.empty())
            tell("{}: warning: {}\n", argv[0], result.no_better);
        return result.interrupted ? static_cast<ExitStatus>(128 + signalled) : success;
    });
}

ExitStatus evaluate_by_words(const rddl_simulator& simulator, const SolverProgram& program,
                             int argc, char** argv) {
    EpisodeOptions episodes;
    episodes.episodes = 100;
    std::string file;
    take_words(argc, argv, evaluation_options(episodes),
               [&](const std::string& word) { file = word; });
    if (file.empty()) throw Failure("name the policy to evaluate", {}, usage_error);
    if (is_endless(*simulator.problem, simulator.problem->horizon)) episodes.horizon = 1000;
    const Policy policy = program.read(simulator, read_file(file));
    const Summary summary = summary_of(run_episodes(simulator, policy, episodes, {}));
    const Estimate& returns = summary.undiscounted_return;
    print("return {:.6g} +- {:.3g}, length {:.6g}, {} of {} terminated, {} faults\n", returns.mean,
          returns.half_width, summary.length.mean, summary.terminated, summary.episodes,
          summary.faulted);
    return success;
}

}  // namespace

int run_solver_program(const rddl_simulator& simulator, const SolverProgram& program, int argc,
                       char** argv) {
    return run_program(argv[0], "", [&] {
        const std::string verb = argc > 1 ? argv[1] : "--help";
        if (verb == "train") return train_by_words(simulator, program, argc, argv);
        if (verb == "evaluate") return evaluate_by_words(simulator, program, argc, argv);
        if (verb != "--help" && verb != "-h")
            throw Failure(fmt::format("'{}' is neither train nor evaluate", verb), {}, usage_error);
        print_help(argv[0], program);
        return success;
    });
}

}  // namespace rddlc::solvers
