// rddl train: learn a policy.
#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "formats/number_text.hpp"
#include "learning/imitation.hpp"
#include "solvers/cgp/option_table.hpp"
#include "solvers/cgp/trainee.hpp"
#include "solvers/drp/trainee.hpp"
#include "solvers/ppo/demonstrations.hpp"
#include "solvers/ppo/option_table.hpp"
#include "solvers/ppo/trainee.hpp"
#include "solvers/spaces/refusals.hpp"
#include "support/files.hpp"
#include "support/program.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <thread>

namespace rddlc::cli {

namespace {

struct TrainOptions {
    ProblemArguments problem;
    LoadOptions load;
    solvers::TrainingOptions training;
    solvers::Settings settings;  // besides those of the learner
    std::string folder;
};

std::filesystem::path folder_of(const TrainOptions& options, const rddl_problem& problem,
                                const char* solver) {
    if (!options.folder.empty()) return options.folder;
    return std::filesystem::path("runs") /
           fmt::format("{}_{}_{}", problem.instance, solver, options.training.seed);
}

// Whether an update may end before it is done: ranks that work together end between updates, where
// they decide alike.
std::function<bool()> stops_of(const solvers::Ranks& ranks) {
    if (ranks.count > 1) return {};
    return is_interrupted;
}

// The options of a learner, with those that are the same for all learners.
template <class LearnerOptions>
LearnerOptions of_run(LearnerOptions learner, const TrainOptions& run,
                      std::function<bool()> stops) {
    learner.seed = run.training.seed;
    learner.memory_limit = run.problem.memory_limit;
    learner.stops = std::move(stops);
    return learner;
}

// A Ctrl-C that leaves no run to continue is a failure too; the status tells the signal.
solvers::TrainingResult train_unless_interrupted(const rddl_simulator& simulator,
                                                 const solvers::Trainee& trainee,
                                                 const solvers::TrainingOptions& training) {
    try {
        return solvers::train(simulator, trainee, training);
    } catch (const Failure& failure) {
        if (!is_interrupted()) throw;
        throw Failure(failure.what(), failure.hint, interrupted_status());
    }
}

ExitStatus run_training(const TrainOptions& options, const rddl_simulator& simulator,
                        const solvers::Trainee& trainee, const solvers::Ranks& ranks) {
    solvers::TrainingOptions training = options.training;
    training.ranks = ranks;
    training.quiet |= !ranks.is_first();
    training.memory_limit = options.problem.memory_limit;
    training.settings = {{"--real", options.load.real == RealType::Float ? "float" : "double"},
                         {"--fast-math", options.load.passes.fast_math ? "true" : "false"}};
    training.settings.insert(training.settings.end(), options.settings.begin(),
                             options.settings.end());
    training.stops = is_interrupted;
    give_up_if_interrupted("making the learner");
    if (!training.quiet && !trainee.note.empty()) tell("rddl: note: {}\n", trainee.note);
    training.folder = folder_of(options, *simulator.problem, trainee.solver.c_str());
    const solvers::TrainingResult result = train_unless_interrupted(simulator, trainee, training);
    if (!training.quiet && result.has_best)
        print("best return {} in {} steps, after {}: {}\n", number_text(result.best_return),
              number_text(result.best_length), duration_text(result.seconds),
              training.folder.string());
    if (!training.quiet && result.has_best && trainee.summary)
        print("{}", trainee.summary(result.best_policy));
    if (!training.quiet && result.faulted > 0)
        tell("rddl: warning: {} of {} episodes of the last evaluation ended by a fault: {}\n",
             result.faulted, result.episodes, result.first_fault);
    if (!training.quiet && !result.not_finite.empty())
        tell("rddl: warning: the return of the last evaluation is not finite: {}\n",
             result.not_finite);
    if (!training.quiet && !result.no_better.empty()) tell("rddl: warning: {}\n", result.no_better);
    if (!result.interrupted) return success;
    if (!ranks.is_first()) return interrupted_status();
    tell("rddl: interrupted; 'rddl train {} ... --out {} --resume' continues it\n", trainee.solver,
         training.folder.string());
    return interrupted_status();
}

ExitStatus train_on_ranks(TrainOptions& options,
                          const std::function<ExitStatus(const solvers::Ranks&)>& train) {
    return solvers::run_on_ranks("rddl", is_interrupted, [&](const solvers::Ranks& ranks) {
        options.load.quiet = options.training.quiet || !ranks.is_first();
        return train(ranks);
    });
}

void add_common_options(Command& command, TrainOptions& options) {
    add_problem_arguments(command, options.problem);
    add_text_option(command, "--out", "FOLDER",
                    "Folder of the run's files (runs/INSTANCE_SOLVER_SEED)", options.folder);
    add_flag(command, "--resume", "Resume the run in that folder, with the same options",
             options.training.resumes);
    add_number_option(command, "--time", "SECONDS", "End after this time", options.training.seconds,
                      0.0, 1e9);
    add_number_option(command, "--stop-return", "RETURN",
                      "End when an evaluation reaches this return", options.training.stop_return,
                      -1e300, 1e300);
    add_number_option<std::int64_t>(command, "--evaluations", "N",
                                    "Evaluations; the best policy of all is kept (20)",
                                    options.training.evaluations, 1, 1'000'000);
    add_number_option<std::int64_t>(
        command, "--evaluation-episodes", "N",
        "Episodes of each evaluation, if anything is drawn at random (20)",
        options.training.evaluation_episodes, 1, 1'000'000);
    add_seed_option(command, options.training.seed, "Seed of all random numbers (0)");
    add_flag(command, "--quiet", "Print nothing", options.training.quiet);
    add_engine_options(command, options.load);
    add_title(command, "--instance", "Problem");
    add_title(command, "--out", "Run");
    add_title(command, "--engine", "Engine");
}

Option& add_learner_option(Command& command, const solvers::OptionText& option,
                           const std::function<void(const std::string&)>& take) {
    if (option.value.empty())
        return add_flag(command, option.name, option.help, [take](const std::string& word) {
            take(word == "true" ? "on" : word == "false" ? "off" : word);
        });
    if (option.is_list)
        return add_list_option(command, option.name, option.value, option.help, take);
    Option& added = add_option(command, option.name, option.value, option.help, take);
    added.choices = option.choices;
    return added;
}

std::vector<std::string> names_elsewhere(const solvers::OptionText& option) {
    std::vector<std::string> names = option.elsewhere;
    names.push_back(option.keyword);
    return names;
}

// All options of a learner's table.
template <class Options>
void add_learner_options(Command& command, const solvers::OptionTable<Options>& table,
                         Options& options) {
    for (const solvers::LearnerOption<Options>& option : table) {
        const std::function<void(const std::string&)> take =
            [&options, &option,
             words = std::vector<std::string>()](const std::string& word) mutable {
                if (!option.is_list) words.clear();
                words.push_back(word);
                try {
                    option.set(options, words);
                } catch (const solvers::OptionRefused& refused) {
                    throw UsageError(fmt::format("{}: {}", option.name, refused.what()));
                }
            };
        add_learner_option(command, option, take).elsewhere = names_elsewhere(option);
    }
}

// --------------------------------------------------------------------------------------- PPO

struct TrainPpoOptions : TrainOptions {
    solvers::PpoOptions ppo;
    Imitation imitation;
};

ExitStatus train_ppo(TrainPpoOptions options, const solvers::Ranks& ranks) {
    const Imitation& imitation = options.imitation;
    if (!imitation.policy.empty())
        options.settings = solvers::settings_of(imitation_option_table(), imitation);
    if (!imitation.policy.empty() && (ranks.count > 1 || options.ppo.recurrent > 0))
        throw Failure("--imitate goes neither with --recurrent nor with several ranks", {},
                      usage_error);
    const LoadedProblem problem = load_problem(options.problem.files(), options.load);
    const rddl_simulator& simulator = *problem.simulator;
    solvers::require_an_end_to_learn(*simulator.problem);
    solvers::PpoOptions ppo = of_run(options.ppo, options, stops_of(ranks));
    ppo.shortens_rollout = !ppo.names_rollout;
    const solvers::Demonstrate shown =
        demonstrate(simulator, imitation, ppo.seed, ppo.memory_limit,
                    {.derivatives = problem.derivatives}, is_interrupted, options.training.quiet);
    return run_training(options, simulator, solvers::ppo_trainee(simulator, ppo, ranks, shown),
                        ranks);
}

Command ppo_command() {
    const auto options = std::make_shared<TrainPpoOptions>();
    Command command;
    command.name = "ppo";
    command.summary = "Learn a neural network by proximal policy optimisation";
    command.details =
        "Takes all kinds of fluents and actions, bounded or not, fully or partially observed\n"
        "('rddl info' shows what a problem has). Refuses problems without an end, without a\n"
        "choice or with too many choices, and says why.\n\n"
        "Examples:\n"
        "  rddl train ppo MountainCar_ippc2023 1 --out runs/a\n"
        "  rddl train ppo CartPole_Continuous_gym 0 --preset sb3 --steps 100000 --seed 3\n"
        "  rddl train ppo SkillTeaching_POMDP_ippc2011 1 --recurrent 32\n"
        "  rddl train ppo RaceCar_ippc2023 2 --imitate plan:cem,seconds=0.1\n"
        "  rddl train ppo MountainCar_ippc2023 1 --out runs/a --resume";
    add_common_options(command, *options);
    add_learner_options(command, imitation_option_table(), options->imitation);
    add_learner_options(command, solvers::ppo_option_table(), options->ppo);
    add_title(command, "--imitate", "Imitation");
    add_title(command, "--preset", "Samples");
    add_title(command, "--lr", "Gradient steps");
    add_title(command, "--noise", "Exploration");
    add_title(command, "--hidden", "Networks");
    add_title(command, "--threads", "Threads");
    command.run = [options] {
        return train_on_ranks(*options, [options](const solvers::Ranks& ranks) {
            return train_ppo(*options, ranks);
        });
    };
    return command;
}

// --------------------------------------------------------------------------------------- CGP

struct TrainCgpOptions : TrainOptions {
    solvers::CgpOptions cgp;
};

ExitStatus train_cgp(const TrainCgpOptions& options, const solvers::Ranks& ranks) {
    const LoadedProblem problem = load_problem(options.problem.files(), options.load);
    const rddl_simulator& simulator = *problem.simulator;
    const solvers::CgpOptions cgp = of_run(options.cgp, options, stops_of(ranks));
    return run_training(options, simulator, solvers::cgp_trainee(simulator, cgp, ranks), ranks);
}

Command cgp_command() {
    const auto options = std::make_shared<TrainCgpOptions>();
    Command command;
    command.name = "cgp";
    command.summary = "Find a formula by Cartesian genetic programming";
    command.details =
        "Takes all kinds of fluents and actions, bounded or not ('rddl info' shows what a problem\n"
        "has). In a partially observed problem programs read only the present observation.\n"
        "Refuses problems without a choice or with too many choices, and says why.\n\n"
        "Examples:\n"
        "  rddl train cgp MountainCar_ippc2023 1 --gens 25 --out runs/c\n"
        "  rddl train cgp Reservoir_ippc2023 1 --time 60 --islands 2 --threads 2";
    add_common_options(command, *options);
    add_learner_options(command, solvers::cgp_option_table(), options->cgp);
    add_title(command, "--gens", "Search");
    add_title(command, "--cols", "Programs");
    add_title(command, "--episodes", "Selection");
    add_title(command, "--lifted", "Forms of programs");
    add_title(command, "--islands", "Islands and threads");
    command.run = [options] {
        return train_on_ranks(*options, [options](const solvers::Ranks& ranks) {
            return train_cgp(*options, ranks);
        });
    };
    return command;
}

// --------------------------------------------------------------------------------------- DRP

struct TrainDrpOptions : TrainOptions {
    solvers::DrpOptions drp;
};

ExitStatus train_drp(TrainDrpOptions options) {
    options.load.quiet = options.training.quiet;
    const LoadedProblem problem = load_problem(options.problem.files(), options.load);
    const rddl_simulator& simulator = *problem.simulator;
    const solvers::DrpOptions drp = of_run(options.drp, options, is_interrupted);
    return run_training(options, simulator,
                        solvers::drp_trainee(simulator, drp, problem.derivatives), {});
}

Command drp_command() {
    const auto options = std::make_shared<TrainDrpOptions>();
    Command command;
    command.name = "drp";
    command.summary = "Learn a neural network by exact gradients of its return";
    command.details =
        "A deep reactive policy: a network of the state that goes up the exact gradient of its\n"
        "return, through all steps of its episodes (docs/planning.md). Reals, ints between bounds\n"
        "and bools have derivatives; objects do not. Refuses problems that hide their state.\n\n"
        "Examples:\n"
        "  rddl train drp UAV_ippc2023 1 --time 30 --out runs/d\n"
        "  rddl evaluate UAV_ippc2023 1 --policy runs/d";
    add_common_options(command, *options);
    add_learner_options(command, solvers::drp_option_table(), options->drp);
    add_title(command, "--steps", "Gradients");
    add_title(command, "--hidden", "Network");
    command.run = [options] {
        return train_drp(*options);
    };
    return command;
}

}  // namespace

Command train_command() {
    Command command;
    command.name = "train";
    command.summary = "Learn a policy";
    command.details = "'rddl help train ppo' lists all options.";
    command.commands = {ppo_command(), cgp_command(), drp_command(), train_plan_command()};
    return command;
}

}  // namespace rddlc::cli
