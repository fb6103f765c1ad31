// rddl train: learn a policy.
#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "formats/number_text.hpp"
#include "solvers/cgp/trainee.hpp"
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

ExitStatus run_training(const TrainOptions& options, const rddl_simulator& simulator,
                        const solvers::Trainee& trainee, const solvers::Ranks& ranks) {
    solvers::TrainingOptions training = options.training;
    training.ranks = ranks;
    training.quiet |= !ranks.is_first();
    training.memory_limit = options.problem.memory_limit;
    training.settings = {{"--real", options.load.real == RealType::Float ? "float" : "double"},
                         {"--fast-math", options.load.passes.fast_math ? "true" : "false"}};
    training.stops = is_interrupted;
    give_up_if_interrupted("making the learner");
    if (!training.quiet && !trainee.note.empty()) tell("rddl: note: {}\n", trainee.note);
    training.folder = folder_of(options, *simulator.problem, trainee.solver.c_str());
    const solvers::TrainingResult result = solvers::train(simulator, trainee, training);
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
    if (!result.interrupted) return success;
    if (!ranks.is_first()) return interrupted_status();
    tell("rddl: interrupted; 'rddl train {} ... --out {} --resume' goes on\n", trainee.solver,
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
                    "Where the run is written (runs/INSTANCE_SOLVER_SEED)", options.folder);
    add_flag(command, "--resume", "Go on with the run in that folder, by the same options",
             options.training.resumes);
    add_number_option(command, "--time", "SECONDS", "End after so long", options.training.seconds,
                      0.0, 1e9);
    add_number_option(command, "--stop-return", "RETURN", "End when an evaluation earns this",
                      options.training.stop_return, -1e300, 1e300);
    add_number_option<std::int64_t>(command, "--evaluations", "N",
                                    "Evaluations; the best policy of all is kept (20)",
                                    options.training.evaluations, 1, 1'000'000);
    add_number_option<std::int64_t>(command, "--evaluation-episodes", "N",
                                    "Episodes of each, where anything is drawn at random (20)",
                                    options.training.evaluation_episodes, 1, 1'000'000);
    add_seed_option(command, options.training.seed, "Seed of all random numbers (0)");
    add_engine_options(command, options.load);
    add_flag(command, "--quiet", "Print nothing", options.training.quiet);
}

// --------------------------------------------------------------------------------------- PPO

struct TrainPpoOptions : TrainOptions {
    solvers::PpoOptions ppo;
    bool names_rollout = false;  // --envs or --rollout is given
};

ExitStatus train_ppo(const TrainPpoOptions& options, const solvers::Ranks& ranks) {
    const LoadedProblem problem = load_problem(options.problem.files(), options.load);
    const rddl_simulator& simulator = *problem.simulator;
    solvers::require_an_end_to_learn(*simulator.problem);
    solvers::PpoOptions ppo = options.ppo;
    ppo.seed = options.training.seed;
    ppo.stops = stops_of(ranks);
    ppo.memory_limit = options.problem.memory_limit;
    ppo.shortens_rollout = !options.names_rollout;
    return run_training(options, simulator, solvers::ppo_trainee(simulator, ppo, ranks), ranks);
}

template <class Choice>
void add_choice_option(Command& command, const std::string& name, const std::string& value,
                       const std::string& explanation, Choice& target,
                       std::vector<std::pair<std::string, Choice>> choices) {
    std::vector<std::string> names;
    for (const auto& [word, choice] : choices) names.push_back(word);
    add_option(command, name, value, explanation, [&target, choices](const std::string& word) {
        for (const auto& [each, choice] : choices)
            if (each == word) target = choice;
    }).choices = names;
}

// The preset comes first, whatever the order of the words.
void add_ppo_options(Command& command, TrainPpoOptions& options) {
    using namespace solvers;
    PpoOptions& ppo = options.ppo;
    add_option(command, "--preset", "PRESET",
               "fast (default), sb3 (as Stable-Baselines3), rllib; options behind it change it",
               [&ppo](const std::string& name) { ppo = *preset(name); })
        .choices = {"fast", "sb3", "rllib"};
    add_option(command, "--steps", "N", "Steps of all environments (1e6)",
               [&ppo](const std::string& word) {
                   ppo.steps =
                       static_cast<std::int64_t>(number_of<double>("--steps", word, 1, 1e15));
               });
    const auto add_size = [&](const char* name, const char* value, const char* explanation,
                              int& target) {
        add_option(command, name, value, explanation,
                   [name, &target, &options](const std::string& word) {
                       target = number_of<int>(name, word, 1, 1 << 20);
                       options.names_rollout = true;
                   });
    };
    add_size("--envs", "N", "Environments (64), of each rank of MPI", ppo.environments);
    add_size("--rollout", "T", "Steps of each between updates (128, or as many as fit into memory)",
             ppo.rollout);
    add_number_option(command, "--epochs", "E", "Passes over what was collected (4)", ppo.epochs, 1,
                      10000);
    add_number_option(command, "--minibatch", "M",
                      "Samples of a step of descent (1024), of each rank of MPI", ppo.minibatch, 1,
                      1 << 30);
    add_number_option(command, "--lr", "RATE", "Learning rate (3e-4)", ppo.learning_rate, 0.0,
                      10.0);
    add_choice_option<LearningRate>(command, "--lr-schedule", "HOW",
                                    "linear (default): down to 0; constant; kl: so that the "
                                    "policy moves evenly",
                                    ppo.schedule,
                                    {{"linear", LearningRate::Linear},
                                     {"constant", LearningRate::Constant},
                                     {"kl", LearningRate::Kl}});
    add_number_option(command, "--gamma", "G", "Discount (0.99, or the instance's if lower)",
                      ppo.gamma, 0.0, 1.0);
    add_number_option(command, "--lambda", "L", "Of generalised advantage estimation (0.95)",
                      ppo.lambda, 0.0, 1.0);
    add_number_option(command, "--clip", "C", "Of the probability ratio (0.2)", ppo.clip, 0.0,
                      10.0);
    add_number_option(command, "--value-clip", "C", "Of values; 0 (default): none", ppo.value_clip,
                      0.0, 1e9);
    add_number_option(command, "--value-weight", "W", "Of the values' error (0.5)",
                      ppo.value_weight, 0.0, 1e9);
    add_number_option(command, "--entropy", "W", "Weight of the entropy (0; 0.01 with choices)",
                      ppo.entropy_weight, 0.0, 1e9);
    add_number_option(command, "--gradient-norm", "N", "Of the gradient, at most (0.5); 0: any",
                      ppo.gradient_norm, 0.0, 1e9);
    add_number_option(command, "--target-kl", "D",
                      "An update ends when the policy has moved by 1.5 times this; 0 (default): "
                      "never",
                      ppo.kl_stop, 0.0, 1e9);
    add_choice_option<Noise>(command, "--noise", "NOISE",
                             "Of reals: ar1 (default), correlated in time; sde, a function of the "
                             "state that changes every "
                             "few steps; or white",
                             ppo.noise,
                             {{"ar1", Noise::Ar1}, {"sde", Noise::Sde}, {"white", Noise::White}});
    add_number_option(command, "--sde-steps", "N", "Steps with the same function, of sde (8)",
                      ppo.noise_steps, 1, 1 << 20);
    add_number_option(command, "--correlation", "R", "Of ar1 between steps (0.9)", ppo.correlation,
                      0.0, 0.9999);
    add_number_option(command, "--log-std", "X", "Logarithm of the noise's deviation at first (0)",
                      ppo.log_deviation, -20.0, 5.0);
    add_choice_option<bool>(command, "--squash", "WHEN",
                            "Whether reals with two bounds are tanh of a normal number (on), or "
                            "cut at their bounds (off, default)",
                            ppo.squashes, {{"on", true}, {"off", false}});
    add_choice_option<bool>(command, "--curiosity", "WHEN",
                            "Whether seeing more of the problem is rewarded as long as nearly all "
                            "episodes earn the same: on (default; off in sb3 and rllib), off",
                            ppo.curious, {{"on", true}, {"off", false}});
    add_list_option(command, "--hidden", "UNITS,...", "Layers of the networks (64,64)",
                    [&ppo, first = true](const std::string& units) mutable {
                        if (first) ppo.hidden.clear();
                        first = false;
                        ppo.hidden.push_back(number_of<int>("--hidden", units, 1, 1 << 16));
                    });
    add_choice_option<Activation>(command, "--activation", "FUNCTION",
                                  "Of hidden layers: tanh (default), or relu, which is faster",
                                  ppo.activation,
                                  {{"tanh", Activation::Tanh}, {"relu", Activation::Relu}});
    add_number_option(command, "--stack", "K", "Observations seen at once (1)",
                      ppo.observations.stack, 1, 1000);
    add_number_option(command, "--recurrent", "UNITS",
                      "Gated recurrent units, which remember what was observed, for problems that "
                      "are observed in part; 0 (default): none",
                      ppo.recurrent, 0, 1 << 14);
    add_number_option(command, "--segment", "T",
                      "Steps through which what is remembered is learned, at most (32)",
                      ppo.segment, 2, 1 << 20);
    add_choice_option<ObservationOptions::Time>(
        command, "--time-input", "WHEN",
        "Whether the policy sees the time: auto (default: horizons up to 200), on, off",
        ppo.observations.time,
        {{"auto", ObservationOptions::Time::Auto},
         {"on", ObservationOptions::Time::On},
         {"off", ObservationOptions::Time::Off}});
    add_choice_option<std::optional<bool>>(
        command, "--bootstrap", "WHEN",
        "Whether what follows the horizon is estimated: auto (default: unless the policy sees the "
        "time), on, off",
        ppo.bootstraps, {{"auto", std::nullopt}, {"on", true}, {"off", false}});
    add_number_option(command, "--threads", "T", "Threads (1)", ppo.threads, 1, most_threads);
}

Command ppo_command() {
    const auto options = std::make_shared<TrainPpoOptions>();
    Command command;
    command.name = "ppo";
    command.summary = "Learn a neural network by proximal policy optimisation";
    command.details =
        "Takes all kinds of fluents and actions, bounded or not, observed in full or in part\n"
        "('rddl info' tells what a problem has). Refuses problems without an end, without a\n"
        "choice or with too many choices, and says why.\n\n"
        "Examples:\n"
        "  rddl train ppo MountainCar_ippc2023 1 --out runs/a\n"
        "  rddl train ppo CartPole_Continuous_gym 0 --preset sb3 --steps 100000 --seed 3\n"
        "  rddl train ppo SkillTeaching_POMDP_ippc2011 1 --recurrent 32\n"
        "  rddl train ppo MountainCar_ippc2023 1 --out runs/a --resume";
    add_common_options(command, *options);
    add_ppo_options(command, *options);
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
    std::vector<std::string> functions;
};

ExitStatus train_cgp(const TrainCgpOptions& options, const solvers::Ranks& ranks) {
    const LoadedProblem problem = load_problem(options.problem.files(), options.load);
    const rddl_simulator& simulator = *problem.simulator;
    solvers::CgpOptions cgp = options.cgp;
    cgp.seed = options.training.seed;
    cgp.memory_limit = options.problem.memory_limit;
    cgp.stops = stops_of(ranks);
    if (!options.functions.empty()) cgp.functions = solvers::functions_named(options.functions);
    return run_training(options, simulator, solvers::cgp_trainee(simulator, cgp, ranks), ranks);
}

void add_cgp_options(Command& command, TrainCgpOptions& options) {
    using namespace solvers;
    CgpOptions& cgp = options.cgp;
    add_number_option<std::int64_t>(command, "--gens", "N", "Generations (1000)", cgp.generations,
                                    1, std::int64_t{1} << 40);
    add_number_option(command, "--lambda", "N",
                      "Children (32, or 8 where anything is drawn at random; 4 with --compat)",
                      cgp.children, 1, 1 << 16);
    add_number_option(command, "--cols", "N", "Nodes (100)", cgp.nodes, 1, 1 << 20);
    add_number_option(command, "--constants", "N", "Constants (4)", cgp.constants, 0, 1 << 10);
    add_number_option(command, "--levels-back", "N", "How far back a node reads; 0 (default): all",
                      cgp.levels_back, 0, 1 << 20);
    add_choice_option<Mutation>(
        command, "--mutation", "HOW",
        "single (default): until one gene that counts is another; gene: each with a probability",
        cgp.mutation, {{"single", Mutation::Single}, {"gene", Mutation::Gene}});
    add_list_option(
        command, "--functions", "NAME,...",
        "Functions, or groups of them: arith, trig, logic (default: these), round, unit",
        [&options](const std::string& name) { options.functions.push_back(name); });
    add_number_option(command, "--episodes", "N",
                      "Of each program (1, or 16 where anything is drawn at random)", cgp.episodes,
                      1, 1 << 20);
    add_choice_option<Measure>(command, "--fitness", "WHAT",
                               "Of the returns: mean (default), median, min, or cvar: the mean of "
                               "the worst fifth",
                               cgp.measure,
                               {{"mean", Measure::Mean},
                                {"median", Measure::Median},
                                {"min", Measure::Minimum},
                                {"cvar", Measure::WorstFifth}});
    add_number_option<std::int64_t>(command, "--restart", "N",
                                    "Begin anew after so many generations without progress (300)",
                                    cgp.restart_after, 0, std::int64_t{1} << 40);
    add_number_option<std::int64_t>(command, "--tune", "N",
                                    "Generations between searches for better constants (50); 0: "
                                    "none",
                                    cgp.tune_every, 0, std::int64_t{1} << 40);
    add_choice_option<Lifting>(
        command, "--lifted", "WHEN",
        "One program for all objects: auto (default: where an action has "
        "objects), on, off",
        cgp.lifting, {{"auto", Lifting::Auto}, {"on", Lifting::On}, {"off", Lifting::Off}});
    add_choice_option<bool>(command, "--parsimony", "WHEN",
                            "Whether of programs that are as good a smaller one is better: on "
                            "(default), off",
                            cgp.parsimony, {{"on", true}, {"off", false}});
    add_flag(command, "--time-input", "Programs read how much of the episode is over", cgp.time);
    add_choice_option<bool>(command, "--compat", "WHOSE",
                            "skdecide: search for programs as scikit-decide has them, by its "
                            "functions and its mutation; none (default)",
                            cgp.skdecide, {{"none", false}, {"skdecide", true}});
    add_number_option(command, "--islands", "N", "Populations (1, or one for each rank of MPI)",
                      cgp.islands, 1, 1 << 12);
    add_number_option<std::int64_t>(command, "--migrate", "N",
                                    "Generations between migrations (50)", cgp.migrate_every, 0,
                                    std::int64_t{1} << 40);
    add_number_option(command, "--threads", "T", "Threads, for islands (1)", cgp.threads, 1,
                      most_threads);
}

Command cgp_command() {
    const auto options = std::make_shared<TrainCgpOptions>();
    Command command;
    command.name = "cgp";
    command.summary = "Find a formula by Cartesian genetic programming";
    command.details =
        "Takes all kinds of fluents and actions, bounded or not ('rddl info' tells what a problem\n"
        "has). Of a problem that is observed in part programs read the present observation alone.\n"
        "Refuses problems without a choice or with too many choices, and says why.\n\n"
        "Examples:\n"
        "  rddl train cgp MountainCar_ippc2023 1 --gens 25 --out runs/c\n"
        "  rddl train cgp Reservoir_ippc2023 1 --time 60 --islands 2 --threads 2";
    add_common_options(command, *options);
    add_cgp_options(command, *options);
    command.run = [options] {
        return train_on_ranks(*options, [options](const solvers::Ranks& ranks) {
            return train_cgp(*options, ranks);
        });
    };
    return command;
}

}  // namespace

Command train_command() {
    Command command;
    command.name = "train";
    command.summary = "Learn a policy";
    command.details = "'rddl help train ppo' tells all options.";
    command.commands = {ppo_command(), cgp_command()};
    return command;
}

}  // namespace rddlc::cli
