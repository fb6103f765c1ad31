// rddl play: our policies in sessions of other programs' servers.
#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "formats/number_text.hpp"
#include "formats/records_json.hpp"
#include "learning/learned_policy.hpp"
#include "protocol/client.hpp"
#include "solvers/evaluation/summary.hpp"
#include "support/files.hpp"
#include "support/json_text.hpp"
#include "support/program.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/progress.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <memory>

namespace rddlc::cli {

namespace {

struct PlayCommandOptions {
    std::string host = "127.0.0.1";
    int port = 2323;
    ProblemArguments problem;  // may be absent: the server's
    LoadOptions load;
    std::string policy = "random";
    std::optional<std::filesystem::path> policy_block;
    std::string problem_name, client = "rddlc";
    PlannerSettings planning;
    std::uint64_t seed = 0;
    double patience = 600;
    bool json = false;
};

// "localhost:2323", "localhost", "[::1]:2323"
void read_address(const std::string& address, PlayCommandOptions& options) {
    const std::size_t colon = address.rfind(':');
    const bool has_port =
        colon != std::string::npos && address.find(']', colon) == std::string::npos;
    options.host = address.substr(0, has_port ? colon : std::string::npos);
    if (options.host.starts_with('[') && options.host.ends_with(']'))
        options.host = options.host.substr(1, options.host.size() - 2);
    if (options.host.empty()) options.host = "127.0.0.1";
    if (has_port) options.port = number_of<int>("ADDRESS", address.substr(colon + 1), 1, 65535);
}

// The text that a server has sent, as a file for as long as it is needed.
class TaskFile {
  public:
    explicit TaskFile(const std::string& task) {
        std::string name = (std::filesystem::temp_directory_path() / "rddl-task-XXXXXX").string();
        if (!mkdtemp(name.data())) throw Failure("there is no place for temporary files");
        folder_ = name;
        UsedFiles used;
        write_file(path(), task, used);
    }
    ~TaskFile() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    TaskFile(const TaskFile&) = delete;

    std::filesystem::path path() const { return folder_ / "task.rddl"; }

  private:
    std::filesystem::path folder_;
};

LoadedProblem load_task(const TaskFile& file, const PlayCommandOptions& options) {
    ProblemFiles files = options.problem.with_options({});
    files.name = "the server's problem";
    files.domain = file.path();
    files.policy = options.policy_block;
    if (files.instance_name.empty()) files.instance_name = options.problem_name;
    return load_problem(files, options.load);
}

void require_sight(const rddl_problem& problem, const std::string& policy) {
    const bool is_blind = policy == "random" || policy == "noop" || policy.ends_with(".jsonl");
    if (problem.partially_observed && !is_blind)
        throw Failure(fmt::format("'{}' would have to see the observations of {} ({}), which "
                                  "servers send without the state",
                                  policy, problem.instance, problem.domain),
                      "random, noop and traces play problems that are observed in part");
}

void report(const Played& played, const rddl_problem& problem, const PlayCommandOptions& options,
            double seconds) {
    const solvers::Estimate returns = solvers::estimate_of(played.returns);
    if (options.json) {
        nlohmann::ordered_json all = nlohmann::ordered_json::array();
        for (const double value : played.returns) all.push_back(json_number(value));
        print("{}", json_document({{"instance", problem.instance},
                                   {"policy", options.policy},
                                   {"returns", all},
                                   {"mean", json_number(returns.mean)},
                                   {"half_width_95", json_number(returns.half_width)},
                                   {"total", json_number(played.total)},
                                   {"turns", played.turns},
                                   {"seconds", seconds}}));
        return;
    }
    print("{} ({}): {} in {} round{}, {} turns, {}\nreturn {} ± {:.3g} ({} to {}), total {}\n",
          problem.instance, problem.domain, options.policy, played.returns.size(),
          played.returns.size() == 1 ? "" : "s", played.turns, duration_text(seconds),
          number_text(returns.mean), returns.half_width, number_text(returns.minimum),
          number_text(returns.maximum), number_text(played.total));
}

ExitStatus play(PlayCommandOptions options) {
    const auto begin = std::chrono::steady_clock::now();
    const bool has_files = !options.problem.first.empty();
    std::optional<LoadedProblem> problem;
    if (has_files) {
        ProblemFiles files = options.problem.files();
        files.policy = options.policy_block;
        problem = load_problem(files, options.load);
        if (options.problem_name.empty())
            options.problem_name = problem->simulator->problem->instance;
    }
    ServerConnection server(connect_to(options.host, options.port), options.patience,
                            is_interrupted);
    const SessionInit session = server.begin_session(options.problem_name, options.client);
    std::optional<TaskFile> task;  // planners may read it again, for derivatives
    if (!problem) {
        if (session.task.empty())
            throw Failure("the server does not send the problem",
                          "name its files: DOMAIN INSTANCE");
        task.emplace(session.task);
        problem = load_task(*task, options);
    }
    const rddl_simulator& simulator = *problem->simulator;
    require_sight(*simulator.problem, options.policy);
    options.planning.derivatives = problem->derivatives;
    Explanations explanations(options.planning, *simulator.problem, problem->used);
    const solvers::Policy policy = policy_named(simulator, options.policy, false, options.seed,
                                                options.problem.memory_limit, options.planning);
    Progress bar(options.policy, session.rounds, !options.json);
    const PlayOptions playing{options.seed, [&](double) { bar.advance(); }, is_interrupted};
    Played played;
    const auto finish = [&] {
        explanations.write(options.policy);
        explanations.finish();
        if (options.json || !options.planning.explain_on_standard_output())
            report(played, *simulator.problem, options,
                   std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    };
    try {
        play_session(server, session, simulator, policy, playing, played);
    } catch (const Failure&) {
        if (!played.returns.empty()) finish();  // what is over counts
        throw;
    }
    finish();
    return success;
}

}  // namespace

Command play_command() {
    const auto options = std::make_shared<PlayCommandOptions>();
    Command command;
    command.name = "play";
    command.summary = "Play a policy against a server of IPPC 2011 to 2018, such as rddlsim";
    command.details =
        "The problem is what the server sends, unless its files are named.\n\n"
        "Examples:\n"
        "  rddl play localhost:2323 --policy plan:uct,seconds=0.1\n"
        "  rddl play localhost:2323 --problem-name elevators_inst_mdp__1 --policy plan:uct\n"
        "  rddl play localhost:2323 Elevators_MDP_ippc2011 1 --policy runs/a";
    add_argument(command, "ADDRESS", "HOST:PORT of the server; the port may be left out (2323)",
                 [options](const std::string& address) { read_address(address, *options); })
        .is_required = true;
    add_problem_arguments(command, options->problem, false);
    add_option(
        command, "--policy", "POLICY",
        "Policy: random (default), noop, rddl (the policy block), a policy file, the folder of a "
        "run, a trace (.jsonl) or a planner (plan:NAME; 'rddl help evaluate' lists them)",
        [options](const std::string& name) {
            if (planners::is_planner(name)) planners::require_planner(name);
            options->policy = name;
        })
        .suggestions = {"random", "noop", "rddl"};
    add_option(command, "--policy-block", "FILE",
               "File with the policy block for the policy 'rddl'",
               [options](const std::string& file) { options->policy_block = file; });
    add_text_option(command, "--problem-name", "NAME",
                    "Problem to ask the server for (the instance's name)", options->problem_name);
    add_text_option(command, "--client", "NAME", "Name to give to the server (rddlc)",
                    options->client);
    add_seed_option(command, options->seed, "Seed of the policy's random numbers (0)");
    add_number_option<double>(command, "--patience", "SECONDS",
                              "Time to wait for a message of the server (600)", options->patience,
                              0.001, 1e9);
    add_planner_options(command, options->planning);
    add_engine_options(command, options->load);
    add_flag(command, "--json", "Print the results as JSON", options->json);
    command.run = [options] {
        return play(*options);
    };
    return command;
}

}  // namespace rddlc::cli
