// rddl run: whole episodes under a policy, and what came of them.
#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "formats/line_stream.hpp"
#include "formats/number_text.hpp"
#include "formats/table.hpp"
#include "formats/trace.hpp"
#include "pictures/picture_options.hpp"
#include "pictures/picture_writer.hpp"
#include "pictures/rollout_pictures.hpp"
#include "rollouts/rollouts.hpp"
#include "solvers/evaluation/summary.hpp"
#include "support/json_text.hpp"
#include "support/program.hpp"
#include "terminal/interrupt.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <optional>

namespace rddlc::cli {

namespace {

using solvers::Summary;

struct RunOptions {
    ProblemArguments problem;
    std::optional<std::filesystem::path> policy_file;
    LoadOptions load;
    RolloutOptions rollouts;
    std::string trace;
    PictureOptions pictures;
    bool json = false;
    bool quiet = false;
};

double steps_per_second(const Rollouts& rollouts) {
    return rollouts.seconds > 0 ? static_cast<double>(rollouts.steps) / rollouts.seconds : 0;
}

// "episode 3, step 7", of a fault or a violation.
std::string when(const auto& event) {
    return fmt::format("episode {}, step {}", event.episode, event.step);
}

// Reports in the form of the compiler's messages; `count` is the number of all illegal actions.
void report_illegal_action(const EpisodeViolation& first, std::int64_t count,
                           Preconditions preconditions, ViolationExplainer& explainer) {
    const char* const severity = preconditions == Preconditions::Error ? "error" : "warning";
    const std::string place =
        count == 1 ? fmt::format(" in {}", when(first))
                   : fmt::format(" in {} (first of {} violations)", when(first), grouped(count));
    tell(explainer.precondition(first.violation).diagnostic(severity, place));
}

bool all_faulted(const Summary& summary) {
    return summary.faulted > 0 && summary.faulted == summary.episodes;
}

// Reports faults to users who see no summary.
void report_faults(const Summary& summary, const EpisodeFault& first) {
    if (summary.faulted == 0) return;
    const std::string_view severity = all_faulted(summary) ? "error" : "warning";
    const std::string episodes = grouped(summary.episodes);
    const std::string who =
        !all_faulted(summary) ? fmt::format("{} of {} episodes", grouped(summary.faulted), episodes)
        : summary.episodes == 1 ? "the only episode"
                                : fmt::format("all {} episodes", episodes);
    tell("rddl: {}: {} faulted; the first fault: {}\n", severity, who, fault_line(first));
}

std::string illegal_actions_line(std::int64_t count, Preconditions preconditions) {
    const std::string text =
        fmt::format("{} action{} violated a precondition", grouped(count), count == 1 ? "" : "s");
    return count == 0 ? text : text + ": " + fate_of_illegal_actions(preconditions);
}

void print_summary(const RunOptions& options, const Summary& summary, const Rollouts& rollouts,
                   const LoadedProblem& problem, ViolationExplainer& explainer) {
    const rddl_problem& description = *problem.simulator->problem;
    print("{} ({}): policy {}, seed {}, {}\n\n", description.instance, description.domain,
          policy_name(options.rollouts), options.rollouts.seed, name_of(engine_of(options.load)));
    TextTable table({{""},
                     {"mean", Align::Right},
                     {"std", Align::Right},
                     {"min", Align::Right},
                     {"max", Align::Right}});
    const auto add = [&](std::string what, const solvers::Estimate& s) {
        table.add_row({std::move(what), number_text(s.mean), number_text(s.deviation),
                       number_text(s.minimum), number_text(s.maximum)});
    };
    add("return", summary.undiscounted_return);
    add("discounted return", summary.discounted_return);
    add("length", summary.length);
    print("{}\n", table.text());
    print("{} episode{}: {} terminated, {} at the horizon, {} broke an invariant, {} faulted\n",
          grouped(summary.episodes), summary.episodes == 1 ? "" : "s", grouped(summary.terminated),
          grouped(summary.horizon), grouped(summary.invariant), grouped(summary.faulted));
    if (rollouts.first_fault) print("first fault: {}\n", fault_line(*rollouts.first_fault));
    if (const auto& first = rollouts.first_broken_invariant)
        print("first broken invariant: {}: {}\n", when(*first),
              explainer.invariant(first->violation).line());
    const Preconditions preconditions = options.rollouts.preconditions;
    if (preconditions != Preconditions::Ignore || summary.illegal_actions > 0)
        print("{}\n", illegal_actions_line(summary.illegal_actions, preconditions));
    print("{} steps in {}: {} steps/s with {} thread{}\n", grouped(rollouts.steps),
          seconds_text(rollouts.seconds), rate_text(steps_per_second(rollouts)), rollouts.threads,
          rollouts.threads == 1 ? "" : "s");
}

nlohmann::ordered_json spread_json(const solvers::Estimate& s) {
    return {{"mean", json_number(s.mean)},
            {"std", json_number(s.deviation)},
            {"min", json_number(s.minimum)},
            {"max", json_number(s.maximum)}};
}

void print_json(const RunOptions& options, const Summary& summary, const Rollouts& rollouts,
                const LoadedProblem& problem, ViolationExplainer& explainer) {
    nlohmann::ordered_json out{{"problem", problem.files.name},
                               {"policy", policy_name(options.rollouts)},
                               {"engine", name_of(engine_of(options.load))},
                               {"seed", options.rollouts.seed},
                               {"episodes", summary.episodes},
                               {"return", spread_json(summary.undiscounted_return)},
                               {"discounted_return", spread_json(summary.discounted_return)},
                               {"length", spread_json(summary.length)},
                               {"terminated", summary.terminated},
                               {"truncated_horizon", summary.horizon},
                               {"truncated_invariant", summary.invariant},
                               {"faulted", summary.faulted},
                               {"first_fault", nullptr},
                               {"refused", summary.refused},
                               {"illegal_actions", summary.illegal_actions},
                               {"first_illegal_action", nullptr},
                               {"first_broken_invariant", nullptr},
                               {"steps", rollouts.steps},
                               {"seconds", rollouts.seconds},
                               {"steps_per_second", steps_per_second(rollouts)},
                               {"threads", rollouts.threads}};
    if (rollouts.first_fault) out["first_fault"] = fault_line(*rollouts.first_fault);
    if (const auto& first = rollouts.first_illegal_action)
        out["first_illegal_action"] =
            when(*first) + ": " + explainer.precondition(first->violation).line();
    if (const auto& first = rollouts.first_broken_invariant)
        out["first_broken_invariant"] =
            when(*first) + ": " + explainer.invariant(first->violation).line();
    print("{}", json_document(out));
}

std::string header_line(const RunOptions& options, const LoadedProblem& problem,
                        std::int64_t horizon) {
    TraceHeader header;
    header.problem = problem.files.name;
    header.files = problem.files.all();
    header.policy = policy_name(options.rollouts);
    header.engine = name_of(engine_of(options.load));
    header.seed = options.rollouts.seed;
    header.episodes = options.rollouts.episodes;
    header.horizon = horizon;
    return trace_header_line(header, *problem.simulator->problem);
}

void require_policy_block(const rddl_simulator& simulator) {
    if (!simulator.policy)
        throw Failure("there is no policy block in the files of the problem",
                      "name the file that has it: --policy=FILE.rddl");
}

void require_drawn_episode(const RunOptions& options) {
    require_pictures();
    const std::int64_t episode = options.pictures.episode.value_or(0);
    if (episode >= options.rollouts.episodes)
        throw Failure(fmt::format("there is no episode {} to draw: {} run, counted from 0", episode,
                                  options.rollouts.episodes),
                      {}, usage_error);
    require_one_on_standard_output(options.pictures, options.json           ? "--json"
                                                     : options.trace == "-" ? "--trace -"
                                                                            : "");
}

// The name of the episode in titles.
std::string course_name(const RunOptions& options) {
    return fmt::format("policy {}, seed {}", policy_name(options.rollouts), options.rollouts.seed);
}

ExitStatus run(const RunOptions& options) {
    if (options.pictures.visualizer == "list") {
        print("{}", visualizer_list());
        return success;
    }
    if (options.pictures.any()) require_drawn_episode(options);
    require_different_files(options.pictures,
                            {options.trace, options.rollouts.planning.explanations});
    ProblemFiles files = options.problem.files();
    files.policy = options.policy_file;
    const LoadedProblem problem = load_problem(files, options.load);
    if (options.rollouts.policy == Policy::Rddl) require_policy_block(*problem.simulator);
    const rddl_problem& description = *problem.simulator->problem;
    const std::int64_t horizon = options.rollouts.horizon.value_or(description.horizon);
    require_an_end(description, horizon);

    // Pictures are drawn from the lines of the trace, whether or not it is written.
    std::optional<LineWriter> trace;
    std::optional<PictureWriter> pictures;
    if (!options.trace.empty()) trace.emplace(options.trace, problem.used);
    if (options.pictures.any()) pictures.emplace(problem, options.pictures, course_name(options));
    TraceSink sink;
    if (trace || pictures) {
        sink = [&](const std::string& lines) {
            if (trace) trace->write(lines);
            if (pictures && !is_interrupted()) draw_lines(lines, *pictures);
        };
        sink(header_line(options, problem, horizon));
    }
    RolloutOptions rollout_options = options.rollouts;
    rollout_options.memory_limit = files.memory_limit;
    rollout_options.planning.derivatives = problem.derivatives;
    Explanations explanations(rollout_options.planning, description, problem.used);
    if (options.pictures.watch) {  // step by step
        rollout_options.threads = 1;
        rollout_options.batch = 1;
    }
    const Rollouts rollouts = run_episodes(*problem.simulator, rollout_options, sink,
                                           !options.quiet && !options.pictures.watch);
    if (trace) trace->finish();
    explanations.write(policy_name(options.rollouts));
    explanations.finish();
    if (pictures && !is_interrupted()) {
        draw_initial_states(rollouts, *pictures);
        pictures->finish();
    }
    if (rollouts.missing_threads > 0)
        tell("rddl: note: the system gives no more than {} of {} threads\n", rollouts.threads,
             rollouts.threads + rollouts.missing_threads);

    const Summary summary = solvers::summary_of(rollouts);
    ViolationExplainer explainer(problem.files, options.load);
    if (const auto& first = rollouts.first_illegal_action)
        report_illegal_action(*first, summary.illegal_actions, options.rollouts.preconditions,
                              explainer);
    if (options.json)
        print_json(options, summary, rollouts, problem, explainer);
    else if (!options.quiet && options.trace != "-" &&
             !options.rollouts.planning.explain_on_standard_output() &&
             !options.pictures.any_on_standard_output())
        print_summary(options, summary, rollouts, problem, explainer);
    if (rollouts.first_fault) report_faults(summary, *rollouts.first_fault);
    const bool failed = summary.refused > 0 || all_faulted(summary);
    if (!is_interrupted()) return failed ? diagnosed : success;
    tell("rddl: interrupted after {} of {} episodes\n", summary.episodes,
         options.rollouts.episodes);
    return interrupted_status();
}

}  // namespace

Command run_command() {
    const auto options = std::make_shared<RunOptions>();
    Command command;
    command.name = "run";
    command.summary = "Run whole episodes and summarise their returns";
    command.details =
        "Episode number e is environment e of the seed: its course does not depend on how many\n"
        "episodes run, in which batches or on how many threads.\n\n"
        "A random action that violates a precondition is repaired: values chosen at random fall "
        "back\n"
        "to their default until it is legal. If not even the default action is, some more actions\n"
        "are tried, then the default action is taken and counted as illegal.\n\n"
        "Examples:\n"
        "  rddl run domain.rddl instance.rddl --episodes 1000\n"
        "  rddl run MountainCar_ippc2023 1 --policy noop --json\n"
        "  rddl run domain.rddl instance.rddl --policy policy.rddl --episodes 100\n"
        "  rddl run domain.rddl instance.rddl --engine interpreter --trace episodes.jsonl\n"
        "  rddl run MountainCar_ippc2023 1 --gif movie.gif";
    add_problem_arguments(command, options->problem);
    add_policy_option(command, options->rollouts.policy, options->policy_file, &options->rollouts);
    RolloutOptions& rollouts = options->rollouts;
    add_number_option<std::int64_t>(command, "--episodes", "N", "Episodes to run (1)",
                                    rollouts.episodes, 1, 100'000'000);
    add_seed_option(command, rollouts.seed, "Seed of all random numbers (0)");
    add_horizon_option(command, rollouts.horizon,
                       "Steps an episode; 0: no horizon (the instance's)");
    add_number_option(command, "--threads", "T", "Threads (one per core)", rollouts.threads, 1,
                      most_threads);
    add_number_option<std::int64_t>(command, "--batch", "B",
                                    "Episodes that a thread steps together", rollouts.batch, 1,
                                    largest_batch);
    add_preconditions_option(command, rollouts.preconditions);
    add_planner_options(command, rollouts.planning);
    add_engine_options(command, options->load);
    add_text_option(command, "--trace", "FILE", "Write every step as a line of JSON; - is stdout",
                    options->trace);
    add_flag(command, "--json", "Print the summary as JSON", options->json);
    add_flag(command, "--quiet", "Print neither progress nor summary", options->quiet);
    add_picture_options(command, options->pictures);
    add_title(command, "--instance", "Problem");
    add_title(command, "--policy", "Policy and episodes");
    add_title(command, "--engine", "Engine");
    add_title(command, "--trace", "Output");
    add_title(command, "--gif", "Pictures");
    command.run = [options] {
        options->load.quiet = options->quiet;
        options->pictures.quiet = options->quiet;
        return run(*options);
    };
    return command;
}

}  // namespace rddlc::cli
