// rddl solve: the best policy of a small problem, exactly.
#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "exact/solution.hpp"
#include "formats/number_text.hpp"
#include "formats/records_json.hpp"
#include "formats/table.hpp"
#include "support/files.hpp"
#include "support/json_text.hpp"
#include "support/program.hpp"
#include "terminal/progress.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <memory>

namespace rddlc::cli {

namespace {

struct SolveCommandOptions {
    ProblemArguments problem;
    LoadOptions load;
    SolveOptions solving;
    std::optional<std::int64_t> horizon;
    std::string out;
    bool json = false;
};

void report(const Solution& solution, const SolvedSize& size, double seconds,
            const SolveCommandOptions& options) {
    const Optimum& optimum = solution.optimum;
    if (options.json) {
        print("{}", json_document({{"instance", solution.problem.instance},
                                   {"optimum", json_number(optimum.value)},
                                   {"error", json_number(optimum.error)},
                                   {"horizon", optimum.horizon},
                                   {"discount", json_number(solution.problem.discount)},
                                   {"states", size.states},
                                   {"actions", size.actions},
                                   {"transitions", size.transitions},
                                   {"seconds", seconds}}));
        return;
    }
    print("{} ({}): optimum {}{}\n", solution.problem.instance, solution.problem.domain,
          number_text(optimum.value),
          optimum.error > 0 ? fmt::format(" ± {:.2g}", optimum.error) : "");
    print("{} states, {} actions, {} transitions, {}, {}\n", grouped(size.states),
          grouped(size.actions), grouped(size.transitions),
          optimum.horizon > 0 ? fmt::format("horizon {}", optimum.horizon)
                              : fmt::format("{} sweeps", optimum.sweeps),
          duration_text(seconds));
}

ExitStatus solve_problem(SolveCommandOptions options) {
    const auto begin = std::chrono::steady_clock::now();
    const ProblemFiles files = options.problem.files();
    UsedFiles used;
    for (const std::filesystem::path& file : files.all()) used.add(file);
    if (!options.out.empty()) {
        if (std::filesystem::path(options.out).extension() != solution_ending)
            throw UsageError(
                fmt::format("--out: '{}' does not end with {}", options.out, solution_ending));
        require_writable(options.out, used);
    }
    if (options.horizon) options.solving.limits.horizon = *options.horizon ? *options.horizon : -1;
    options.solving.limits.memory = options.problem.memory_limit;
    SolvedSize size;
    const Solution solution = solve(files, options.load, options.solving, size);
    if (!options.out.empty()) write_file(options.out, solution_text(solution), used);
    report(solution, size,
           std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
           options);
    return success;
}

}  // namespace

Command solve_command() {
    const auto options = std::make_shared<SolveCommandOptions>();
    Command command;
    command.name = "solve";
    command.summary = "Find the optimal policy of a small discrete problem, exactly";
    command.details =
        "Lists all states that can be reached, and what each action leads to with which\n"
        "probability; then dynamic programming. The optimum is the greatest expected sum of\n"
        "discounted rewards.\n\n"
        "Examples:\n"
        "  rddl solve Navigation_MDP_ippc2011 1 --out navigation.optimum\n"
        "  rddl compare Navigation_MDP_ippc2011 1 --policies random,navigation.optimum \\\n"
        "      --optimum navigation.optimum";
    add_problem_arguments(command, options->problem);
    add_text_option(command, "-o,--out", "FILE.optimum",
                    "Write the policy, which --policy takes, with its value", options->out);
    add_horizon_option(command, options->horizon,
                       "Steps an episode; 0: no horizon (the instance's)");
    add_number_option<std::int64_t>(command, "--max-states", "N",
                                    "Refuse problems of which more can be reached (10000000)",
                                    options->solving.limits.states, 1, 4'000'000'000);
    add_number_option<std::int64_t>(command, "--max-actions", "N",
                                    "Refuse problems with more joint actions (4096)",
                                    options->solving.actions, 1, 1 << 24);
    add_number_option<std::int64_t>(command, "--max-outcomes", "N",
                                    "Refuse problems whose steps have more outcomes (1048576)",
                                    options->solving.limits.outcomes, 1, std::int64_t{1} << 40);
    add_number_option(command, "--threads", "T", "Threads (one per core)",
                      options->solving.limits.threads, 1, most_threads);
    add_flag(command, "--cheat", "Solve a problem that hides its state as if it did not",
             options->solving.cheat);
    add_extern_option(command, options->load, "C++ header or .so of the external functions");
    add_flag(command, "--json", "Print the results as JSON", options->json);
    command.run = [options] {
        return solve_problem(*options);
    };
    return command;
}

}  // namespace rddlc::cli
