// `rddl train plan`: a plan of the whole episode by gradients, written as a trace.
#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "formats/line_stream.hpp"
#include "formats/number_text.hpp"
#include "formats/trace.hpp"
#include "learning/learned_policy.hpp"
#include "rollouts/evaluation.hpp"
#include "rollouts/rollouts.hpp"
#include "solvers/batches/batch.hpp"
#include "support/failure.hpp"
#include "support/program.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/progress.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <sstream>

namespace rddlc::cli {

namespace {

struct TrainPlanOptions {
    ProblemArguments problem;
    LoadOptions load;
    std::string out;
    double seconds = 10;
    std::optional<std::int64_t> iterations;
    std::optional<std::int64_t> horizon;
    std::int64_t episodes = 100;
    std::uint64_t seed = 0;
};

// The planner that searches once, and plays what it has found.
std::string planner_of(const TrainPlanOptions& options, std::int64_t horizon) {
    const std::string budget = options.iterations
                                   ? fmt::format("iterations={}", *options.iterations)
                                   : fmt::format("seconds={}", options.seconds);
    return fmt::format("plan:gradient,{},horizon={},replan={}", budget, horizon, horizon);
}

std::int64_t in_milliseconds(double seconds) {
    return std::llround(1000 * seconds);
}

// A signal ends the search in the first step, and the episode is then played to its end by the plan
// that was found. Before the first of the `gradients` there is no plan, so that nothing is played.
// A bar shows the part of `seconds` that has passed.
solvers::Policy ending_search_by_signals(solvers::Policy policy,
                                         std::shared_ptr<const std::int64_t> gradients,
                                         std::optional<double> seconds) {
    policy.start = [start = policy.start, gradients, seconds](std::int64_t environments) {
        const solvers::Actor actor = start(environments);
        give_up_if_interrupted("making the planner");
        return [actor, gradients, seconds](solvers::Decision& decision) {
            const bool searches = decision.steps.front() == 0;
            Progress bar("searching", in_milliseconds(seconds.value_or(0)), searches && seconds);
            const auto begin = std::chrono::steady_clock::now();
            const solvers::Stops stops = [&] {
                bar.reach(in_milliseconds(
                    std::chrono::duration<double>(std::chrono::steady_clock::now() - begin)
                        .count()));
                return is_interrupted();
            };
            decision.stops = searches ? &stops : nullptr;
            actor(decision);
            if (searches && *gradients == 0)
                give_up_if_interrupted("computing the first gradient: there is no plan yet");
        };
    };
    return policy;
}

// Counts what the lines of a trace show of a plan.
struct PlanLines {
    std::int64_t steps = 0;
    std::int64_t active = 0;  // steps whose action is not the default

    void count(const std::string& lines) {
        std::istringstream stream(lines);
        for (std::string line; std::getline(stream, line); ++steps)
            if (line.find("\"action\":{}") == std::string::npos) ++active;
    }
};

void report(const rddl_simulator& simulator, const TrainPlanOptions& options,
            const solvers::EpisodeOptions& given) {
    solvers::EpisodeOptions episodes = given;
    episodes.episodes = simulator.problem->stochastic ? options.episodes : 1;
    episodes.preconditions = Preconditions::Warn;  // counted
    for (const std::string& policy : {std::string("noop"), options.out}) {
        if (is_interrupted()) return;
        const Evaluation found = evaluate(simulator, policy, episodes, false, true);
        if (is_interrupted()) return;  // these are not all episodes
        print("{:<30} {:>14}\n", policy, number_text(found.summary.undiscounted_return.mean));
        if (found.summary.illegal_actions > 0)
            tell("rddl: warning: {} of {} steps of '{}' violate preconditions\n",
                 found.summary.illegal_actions, found.steps, policy);
    }
}

ExitStatus train_plan(const TrainPlanOptions& options) {
    if (options.out.empty())
        throw Failure("a plan needs a file: --out plan.jsonl", {}, usage_error);
    if (std::filesystem::path(options.out).extension() != ".jsonl")
        throw Failure(
            fmt::format("the name of a plan ends with .jsonl, and '{}' does not", options.out),
            "--policy takes a plan by this ending", usage_error);
    const LoadedProblem problem = load_problem(options.problem.files(), options.load);
    const rddl_simulator& simulator = *problem.simulator;
    const std::int64_t horizon = options.horizon.value_or(simulator.problem->horizon);
    if (horizon <= 0)
        throw Failure("a plan has an end, and this problem has no horizon", "give one: --horizon N",
                      usage_error);
    RolloutOptions rollouts;
    rollouts.policy = Policy::Planner;
    rollouts.planner = planner_of(options, horizon);
    rollouts.planning.derivatives = problem.derivatives;
    rollouts.planning.cheat = true;  // a plan looks at no state but the first
    const auto gradients = std::make_shared<std::int64_t>(0);
    rollouts.planning.explain = [gradients](const planners::Explanation& explanation) {
        *gradients += explanation.iterations;
    };
    rollouts.seed = options.seed;
    rollouts.horizon = options.horizon;
    rollouts.memory_limit = options.problem.memory_limit;
    const TraceHeader header{.problem = problem.files.name,
                             .files = problem.files.all(),
                             .policy = rollouts.planner,
                             .engine = std::string(name_of(engine_of(options.load))),
                             .seed = options.seed,
                             .episodes = 1,
                             .horizon = horizon};
    LineWriter trace(options.out, problem.used);
    trace.write(trace_header_line(header, *simulator.problem));
    give_up_if_interrupted("making the planner");
    const solvers::Policy policy = ending_search_by_signals(
        policy_named(simulator, rollouts.planner, false, options.seed, rollouts.memory_limit,
                     rollouts.planning),
        gradients, options.iterations ? std::nullopt : std::optional(options.seconds));
    PlanLines plan;
    run_episodes(simulator, policy, rollouts,
                 [&](const std::string& lines) {
                     trace.write(lines);
                     plan.count(lines);
                 },
                 false, {});
    if (plan.steps == 0)
        throw Failure("the episode is over before its first action: there is nothing to plan");
    trace.finish();
    if (plan.active == 0)
        tell(
            "rddl: note: each action of the plan is the default: no better plan was found in this "
            "time\n");
    if (is_interrupted()) {
        tell("rddl: interrupted; '{}' is the best plan so far, of {} steps\n", options.out,
             plan.steps);
        return interrupted_status();
    }
    print("mean returns{}:\n",
          simulator.problem->stochastic
              ? fmt::format(" of {} episode{}", options.episodes, options.episodes == 1 ? "" : "s")
              : std::string());
    report(simulator, options, rollouts);
    if (!is_interrupted()) return success;
    tell("rddl: interrupted before all was evaluated; '{}' holds the plan\n", options.out);
    return interrupted_status();
}

}  // namespace

Command train_plan_command() {
    const auto options = std::make_shared<TrainPlanOptions>();
    Command command;
    command.name = "plan";
    command.summary = "Find a plan of actions by gradients";
    command.details =
        "One plan for the whole episode, whatever happens, that goes up the exact gradient of its\n"
        "return over several draws of luck (docs/planning.md). It is written as a trace, which\n"
        "--policy plan.jsonl plays. plan:gradient searches again at each step instead.\n\n"
        "Examples:\n"
        "  rddl train plan HVAC_ippc2023 1 --out plan.jsonl --seconds 30\n"
        "  rddl evaluate HVAC_ippc2023 1 --policy plan.jsonl";
    add_problem_arguments(command, options->problem);
    add_text_option(command, "--out", "FILE.jsonl", "File of the plan", options->out);
    add_number_option(command, "--seconds", "S", "Time of the search (10)", options->seconds, 0.0,
                      1e6);
    add_number_option<std::int64_t>(
        command, "--iterations", "N",
        "Gradients of each plan, in place of a time: the same bytes each time", options->iterations,
        1, 1'000'000'000);
    add_horizon_option(command, options->horizon, "Steps of the plan (the instance's)");
    add_number_option<std::int64_t>(command, "--episodes", "N",
                                    "Episodes in which the plan is evaluated (100)",
                                    options->episodes, 1, 1'000'000);
    add_seed_option(command, options->seed, "Seed of all random numbers (0)");
    add_engine_options(command, options->load);
    command.run = [options] {
        return train_plan(*options);
    };
    return command;
}

}  // namespace rddlc::cli
