// rddl evaluate and rddl compare: returns of policies, with confidence intervals, on the same
// seeds.
#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "exact/solution.hpp"
#include "formats/number_text.hpp"
#include "formats/records_json.hpp"
#include "formats/table.hpp"
#include "learning/learned_policy.hpp"
#include "pictures/charts.hpp"
#include "rollouts/evaluation.hpp"
#include "rollouts/rollouts.hpp"
#include "support/json_text.hpp"
#include "support/program.hpp"
#include "terminal/interrupt.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

namespace rddlc::cli {

namespace {

struct EvaluationOptions {
    ProblemArguments problem;
    LoadOptions load;
    std::vector<std::string> policies;
    std::optional<std::filesystem::path> policy_block;
    solvers::EpisodeOptions episodes;
    bool random = false;  // learned policies act at random, as they do while they learn
    bool json = false;
    PlannerSettings planning;
    ChartFiles chart;
    std::string optimum;  // a solution's file, or "now"; "": the optimum is not asked for
};

// The greatest discounted return that a policy can have on average.
struct KnownOptimum {
    double value = 0;
    // Both are sums of the same numbers in another order, if the policy is as good.
    double below(const Evaluation& one) const {
        const double difference = value - one.summary.discounted_return.mean;
        return std::abs(difference) <= 1e-12 * std::abs(value) ? 0 : difference;
    }
};

// A figure of episodes, of which an interrupted evaluation may have none.
std::string text_if_any(const solvers::Summary& summary, const std::string& text) {
    return summary.episodes > 0 ? text : "-";
}

std::string interval_text(const solvers::Estimate& estimate) {
    const std::string mean = number_text(estimate.mean);
    return estimate.half_width > 0 ? fmt::format("{} ± {:.3g}", mean, estimate.half_width) : mean;
}

std::string share_text(std::int64_t part, std::int64_t all) {
    return fmt::format("{:.0f} %", 100.0 * static_cast<double>(part) / static_cast<double>(all));
}

void print_table(const rddl_problem& problem, const std::vector<Evaluation>& all,
                 const std::optional<KnownOptimum>& optimum, const EvaluationOptions& options) {
    print("{} ({}): {} episodes, seed {}\n\n", problem.instance, problem.domain,
          options.episodes.episodes, options.episodes.seed);
    std::vector<Column> columns{{"policy"},
                                {"return", Align::Right},
                                {"discounted", Align::Right},
                                {"std", Align::Right},
                                {"min", Align::Right},
                                {"max", Align::Right},
                                {"length", Align::Right},
                                {"ended", Align::Right},
                                {"illegal", Align::Right},
                                {"faults", Align::Right},
                                {"steps/s", Align::Right}};
    if (optimum) columns.push_back({"below optimum", Align::Right});
    TextTable table(columns);
    for (const Evaluation& one : all) {
        const solvers::Summary& s = one.summary;
        const auto figure = [&s](const std::string& text) {
            return text_if_any(s, text);
        };
        table.add_row(
            {one.policy, figure(interval_text(s.undiscounted_return)),
             figure(interval_text(s.discounted_return)),
             figure(number_text(s.undiscounted_return.deviation)),
             figure(number_text(s.undiscounted_return.minimum)),
             figure(number_text(s.undiscounted_return.maximum)), figure(number_text(s.length.mean)),
             figure(share_text(s.terminated, s.episodes)), grouped(s.illegal_actions),
             grouped(s.faulted),
             rate_text(one.seconds > 0 ? static_cast<double>(one.steps) / one.seconds : 0),
             optimum ? figure(number_text(optimum->below(one))) : ""});
    }
    if (optimum)
        table.add_row(
            {"optimum", "", number_text(optimum->value), "", "", "", "", "", "", "", "", "0"});
    print(
        "{}\n± is the half of a 95 % confidence interval; 'ended' are episodes that a "
        "termination ended\n",
        table.text());
}

// Null for each figure if there are no episodes.
nlohmann::ordered_json to_json(const solvers::Estimate& e, std::int64_t episodes) {
    const auto figure = [episodes](double value) {
        return episodes > 0 ? json_number(value) : nlohmann::ordered_json();
    };
    return {{"mean", figure(e.mean)},
            {"half_width_95", figure(e.half_width)},
            {"std", figure(e.deviation)},
            {"min", figure(e.minimum)},
            {"max", figure(e.maximum)}};
}

void print_json(const ProblemFiles& files, const std::vector<Evaluation>& all,
                const std::optional<KnownOptimum>& optimum, const EvaluationOptions& options) {
    nlohmann::ordered_json policies = nlohmann::ordered_json::array();
    for (const Evaluation& one : all) {
        const solvers::Summary& s = one.summary;
        policies.push_back({{"policy", one.policy},
                            {"episodes", s.episodes},
                            {"return", to_json(s.undiscounted_return, s.episodes)},
                            {"discounted_return", to_json(s.discounted_return, s.episodes)},
                            {"length", to_json(s.length, s.episodes)},
                            {"terminated", s.terminated},
                            {"truncated_horizon", s.horizon},
                            {"truncated_invariant", s.invariant},
                            {"faulted", s.faulted},
                            {"illegal_actions", s.illegal_actions},
                            {"steps", one.steps},
                            {"seconds", one.seconds}});
        if (optimum)
            policies.back()["below_optimum"] =
                s.episodes > 0 ? json_number(optimum->below(one)) : nlohmann::ordered_json();
    }
    nlohmann::ordered_json document{{"problem", files.name},
                                    {"episodes", options.episodes.episodes},
                                    {"seed", options.episodes.seed}};
    if (optimum) document["optimum"] = json_number(optimum->value);
    document["policies"] = policies;
    print("{}", json_document(document));
}

void draw(const rddl_problem& problem, const std::vector<Evaluation>& all,
          const EvaluationOptions& options) {
    IntervalChart chart;
    chart.title = fmt::format("{}: {} episodes", problem.instance, options.episodes.episodes);
    chart.x_title = "return: mean, 95 % confidence interval of it, least and greatest";
    for (const Evaluation& one : all) {
        if (one.summary.episodes == 0) continue;  // after an interrupt
        const solvers::Estimate& e = one.summary.undiscounted_return;
        chart.rows.push_back({one.policy, e.mean, e.half_width, e.minimum, e.maximum});
    }
    write_chart(chart, options.chart);
}

// Prints a note if the likeliest actions have a much lower return than random ones had.
void hint_at_chance(const Evaluation& one) {
    const std::optional<double> learned = learned_return(one.policy);
    if (!learned) return;
    const solvers::Estimate& earned = one.summary.undiscounted_return;
    const double size = std::max(std::abs(*learned), std::abs(earned.mean));
    if (*learned - earned.mean > std::max(size / 2, 3 * earned.half_width))
        tell(
            "rddl: note: while '{}' learned, the mean return of its last episodes was {} with "
            "random actions, as "
            "--stochastic takes them\n",
            one.policy, number_text(*learned));
}

// Says where a return may be high only because episodes ended early, and why they did.
void note_faults(const Evaluation& one) {
    const solvers::Summary& s = one.summary;
    if (s.faulted == 0) return;
    tell("rddl: note: faults ended {} of {} episodes of '{}', so its return is of fewer steps\n",
         grouped(s.faulted), grouped(s.episodes), one.policy);
    if (one.first_fault) tell("  the first fault: {}\n", fault_line(*one.first_fault));
}

// The optimum of the horizon in which policies are evaluated.
std::optional<KnownOptimum> optimum_of(const ProblemFiles& files, const rddl_simulator& simulator,
                                       const EvaluationOptions& options) {
    if (options.optimum.empty()) return std::nullopt;
    const std::int64_t horizon = options.episodes.horizon.value_or(simulator.problem->horizon);
    Solution solution;
    if (options.optimum == "now") {
        SolveOptions solving;
        solving.cheat = options.planning.cheat;
        solving.limits.horizon = horizon > 0 ? horizon : -1;
        solving.limits.memory = files.memory_limit;
        solving.limits.threads = options.episodes.threads;
        SolvedSize size;
        solution = solve(files, options.load, solving, size);
    } else {
        try {
            solution = read_solution(simulator, policy_text(options.optimum));
        } catch (const Failure& failure) {
            throw Failure(fmt::format("cannot take the optimum from '{}': {}", options.optimum,
                                      failure.what()),
                          failure.hint, failure.status);
        }
    }
    if (solution.optimum.horizon != horizon)
        throw Failure(fmt::format("the optimum in '{}' is of {} steps, and episodes have {}",
                                  options.optimum, solution.optimum.horizon, horizon),
                      "solve the problem with this --horizon");
    return KnownOptimum{solution.optimum.value};
}

// A file with a policy block has a problem of its own, which is loaded with it.
Evaluation evaluate_one(const rddl_simulator& simulator, const ProblemFiles& files,
                        const std::string& name, const EvaluationOptions& options) {
    if (!is_block_file(name))
        return evaluate(simulator, name, options.episodes, options.random, options.json,
                        options.planning);
    ProblemFiles own = files;
    own.policy = name;
    const LoadedProblem problem = load_problem(own, options.load);
    Evaluation one = evaluate(*problem.simulator, "rddl", options.episodes, options.random,
                              options.json, options.planning);
    one.policy = name;
    return one;
}

ExitStatus evaluate_all(const EvaluationOptions& options) {
    if (options.chart.any()) require_writable_chart(options.chart);
    ProblemFiles files = options.problem.files();
    files.policy = options.policy_block;
    const LoadedProblem problem = load_problem(files, options.load);
    const rddl_simulator& simulator = *problem.simulator;
    require_an_end(*simulator.problem,
                   options.episodes.horizon.value_or(simulator.problem->horizon));
    const std::optional<KnownOptimum> optimum = optimum_of(files, simulator, options);
    EvaluationOptions chosen = options;
    chosen.episodes.preconditions = Preconditions::Warn;  // so that they are counted
    chosen.episodes.memory_limit = files.memory_limit;
    chosen.planning.derivatives = problem.derivatives;
    Explanations explanations(chosen.planning, *simulator.problem, problem.used);
    std::vector<Evaluation> all;
    for (const std::string& name : options.policies) {
        if (is_interrupted()) break;
        all.push_back(evaluate_one(simulator, files, name, chosen));
        explanations.write(name);
    }
    explanations.finish();
    if (options.json)
        print_json(files, all, optimum, options);
    else if (!options.planning.explain_on_standard_output())
        print_table(*simulator.problem, all, optimum, options);
    const bool has_episodes = std::any_of(
        all.begin(), all.end(), [](const Evaluation& one) { return one.summary.episodes > 0; });
    if (options.chart.any() && has_episodes) draw(*simulator.problem, all, options);
    for (const Evaluation& one : all) note_faults(one);
    for (const Evaluation& one : all)
        if (!options.random && !is_interrupted()) hint_at_chance(one);
    if (!is_interrupted()) return success;
    tell("rddl: interrupted before all was evaluated\n");
    return interrupted_status();
}

void add_common_options(Command& command, EvaluationOptions& options) {
    options.episodes.episodes = 100;
    add_number_option<std::int64_t>(command, "--episodes", "N", "Episodes of each policy (100)",
                                    options.episodes.episodes, 1, 100'000'000);
    add_seed_option(command, options.episodes.seed, "Seed of all random numbers (0)");
    add_horizon_option(command, options.episodes.horizon,
                       "Steps an episode; 0: no horizon (the instance's)");
    add_number_option(command, "--threads", "T", "Threads (one per core)", options.episodes.threads,
                      1, most_threads);
    add_option(command, "--policy-block", "FILE",
               "File with the policy block for the policy 'rddl'",
               [&options](const std::string& file) { options.policy_block = file; });
    add_flag(command, "--stochastic", "Learned policies sample their actions, as during training",
             options.random);
    add_planner_options(command, options.planning);
    add_engine_options(command, options.load);
    add_flag(command, "--json", "Print the results as JSON", options.json);
}

// Options of a planner also have commas between them: key=value belongs to the planner before it.
void add_policy(std::vector<std::string>& policies, const std::string& word) {
    const std::size_t sign = word.find('=');
    const bool is_option =
        sign != std::string::npos && word.find_first_not_of("abcdefghijklmnopqrstuvwxyz-_") == sign;
    if (is_option && !policies.empty() && planners::is_planner(policies.back()))
        policies.back() += "," + word;
    else
        policies.push_back(word);
}

// All planners with their options.
std::string planner_help() {
    std::string text =
        "Planners are policies that search before each action: plan:NAME[,key=value...], such as\n"
        "plan:cem,seconds=0.1 (docs/planning.md).\n";
    for (const planners::PlannerText& planner : planners::planner_texts()) {
        text += fmt::format("\nplan:{}: {}\n", planner.name, planner.summary);
        for (const solvers::OptionText& option : planner.options)
            text += help_entry(option.name + "=" + option.value, option.help);
    }
    return text;
}

}  // namespace

Command evaluate_command() {
    const auto options = std::make_shared<EvaluationOptions>();
    Command command;
    command.name = "evaluate";
    command.summary = "Run episodes of a policy and report its mean return";
    command.details =
        "Examples:\n"
        "  rddl evaluate MountainCar_ippc2023 1 --policy runs/a\n"
        "  rddl evaluate domain.rddl instance.rddl --policy random --episodes 1000 --json\n"
        "  rddl evaluate MountainCar_ippc2023 1 --policy plan:cem,seconds=0.1 --episodes 10\n\n" +
        planner_help();
    add_problem_arguments(command, options->problem);
    add_option(
        command, "--policy", "POLICY",
        "Policy: random, noop, rddl (the policy block of the problem), a file with a policy block "
        "(.rddl), a policy file, the folder of a run, a trace (.jsonl), whose episodes are "
        "played one after the other, or a planner (plan:NAME)",
        [options](const std::string& name) {
            if (planners::is_planner(name)) planners::require_planner(name);
            options->policies = {name};
        })
        .suggestions = {"random", "noop", "rddl"};
    add_common_options(command, *options);
    command.run = [options] {
        if (options->policies.empty()) options->policies = {"random"};
        return evaluate_all(*options);
    };
    return command;
}

Command compare_command() {
    const auto options = std::make_shared<EvaluationOptions>();
    Command command;
    command.name = "compare";
    command.summary = "Put several policies into one table, on the same seeds";
    command.details =
        "Examples:\n"
        "  rddl compare MountainCar_ippc2023 1 --policies random,noop,runs/ppo,runs/cgp\n"
        "  rddl compare MountainCar_ippc2023 1 --policies noop,runs/ppo --png returns.png\n"
        "  rddl compare Elevators_MDP_ippc2011 1 --policies noop,plan:uct --optimum now";
    add_problem_arguments(command, options->problem);
    add_list_option(command, "--policies", "POLICY,...",
                    "Policies: random, noop, rddl (the policy block of the problem), files with "
                    "policy blocks (.rddl), "
                    "policy files, folders of runs, traces (.jsonl) as plans, planners "
                    "(plan:NAME,key=value,...)",
                    [options](const std::string& name) { add_policy(options->policies, name); })
        .suggestions = {"random", "noop", "rddl"};
    add_text_option(
        command, "--optimum", "FILE.optimum",
        "Show how far policies are below the optimum that 'rddl solve' has found; 'now' "
        "solves the problem first",
        options->optimum)
        .suggestions = {"now"};
    add_common_options(command, *options);
    add_chart_options(command, options->chart);
    command.run = [options] {
        for (const std::string& name : options->policies)
            if (planners::is_planner(name)) planners::require_planner(name);
        if (options->policies.empty()) options->policies = {"noop", "random"};
        return evaluate_all(*options);
    };
    return command;
}

}  // namespace rddlc::cli
