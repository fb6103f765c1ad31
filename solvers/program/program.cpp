#include "solvers/program/program.hpp"

#include "solvers/evaluation/summary.hpp"
#include "solvers/spaces/refusals.hpp"
#include "support/files.hpp"
#include "support/program.hpp"

#include <fmt/format.h>

#include <charconv>
#include <csignal>

namespace rddlc::solvers {

namespace {

volatile std::sig_atomic_t signalled = 0;  // by which signal

void note_signal(int signal) {
    signalled = signal;
}

void print_help(const char* name, const SolverProgram& program) {
    print(
        "Usage: {0} train --out FOLDER [--resume] [--seed S] [--time SECONDS] [--stop-return R]\n"
        "       {0} evaluate POLICY [--episodes N] [--seed S]\n\n"
        "Options of train:\n{1}",
        name, program.help);
}

// Takes the words from `first` on; those that are not "--..." go to `take_other`.
void take_words(int first, int argc, char** argv, const WordTakers& options,
                const std::function<void(const std::string&)>& take_other) {
    for (int i = first; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--resume" || !word.starts_with("--")) {
            take_other(word);
            continue;
        }
        const auto option = options.find(word);
        if (option == options.end())
            throw Failure(fmt::format("unknown option '{}'", word), {}, usage_error);
        if (++i == argc) throw Failure(fmt::format("{} needs a value", word), {}, usage_error);
        option->second(argv[i]);
    }
}

ExitStatus train_by_words(const rddl_simulator& simulator, const SolverProgram& program, int argc,
                          char** argv) {
    TrainingOptions training;
    WordTakers options = program.options;
    options["--out"] = [&](const std::string& word) {
        training.folder = word;
    };
    options["--seed"] = [&](const std::string& word) {
        training.seed = static_cast<std::uint64_t>(number_in("--seed", word));
    };
    options["--time"] = [&](const std::string& word) {
        training.seconds = number_in("--time", word);
    };
    options["--stop-return"] = [&](const std::string& word) {
        training.stop_return = number_in("--stop-return", word);
    };
    take_words(2, argc, argv, options, [&](const std::string& word) {
        if (word != "--resume")
            throw Failure(fmt::format("too many words: '{}'", word), {}, usage_error);
        training.resumes = true;
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
        return result.interrupted ? static_cast<ExitStatus>(128 + signalled) : success;
    });
}

ExitStatus evaluate_by_words(const rddl_simulator& simulator, const SolverProgram& program,
                             int argc, char** argv) {
    EpisodeOptions episodes;
    episodes.episodes = 100;
    std::string file;
    const WordTakers options = {
        {"--episodes",
         [&](const std::string& word) {
             episodes.episodes = static_cast<std::int64_t>(number_in("--episodes", word));
         }},
        {"--seed", [&](const std::string& word) {
             episodes.seed = static_cast<std::uint64_t>(number_in("--seed", word));
         }}};
    take_words(2, argc, argv, options, [&](const std::string& word) { file = word; });
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

double number_in(const std::string& option, const std::string& word) {
    double number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size())
        throw Failure(fmt::format("{}: '{}' is no number", option, word), {}, usage_error);
    return number;
}

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
