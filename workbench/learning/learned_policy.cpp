#include "learning/learned_policy.hpp"

#include "exact/solution.hpp"
#include "formats/line_stream.hpp"
#include "formats/trace.hpp"
#include "formats/trace_steps.hpp"
#include "learning/learning_curves.hpp"
#include "solvers/cgp/policy_file.hpp"
#include "solvers/ppo/policy.hpp"
#include "solvers/ppo/policy_file.hpp"
#include "solvers/training/training.hpp"
#include "support/failure.hpp"
#include "support/files.hpp"
#include "support/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace rddlc::workbench {

namespace {

// Devices have no end. A network of 4,096 and 4,096 units takes 0.5 GB.
constexpr std::size_t largest_policy = std::size_t{1} << 30;

}  // namespace

std::string policy_text(const std::filesystem::path& path) {
    const std::filesystem::path file = policy_file(path);
    if (!is_there(path))
        throw Failure(fmt::format("there is no policy file, nor the folder of a run, named '{}'",
                                  path.string()),
                      {}, usage_error);
    if (!is_there(file))
        throw Failure(fmt::format("there is no {} in the folder '{}'", file.filename().string(),
                                  path.string()),
                      "'rddl train' writes policy.json or policy.cgp into the folder of a run",
                      usage_error);
    return read_file(file, largest_policy);
}

std::filesystem::path policy_file(const std::filesystem::path& path) {
    if (!is_folder(path)) return path;
    if (const std::string solver = solver_of_run(path); !solver.empty())
        return path / ("policy" + solvers::policy_extension(solver));
    const std::filesystem::path formula = path / "policy.cgp", network = path / "policy.json";
    if (is_there(formula) && is_there(network))
        throw Failure(
            fmt::format("the folder '{}' holds policy.cgp and policy.json, and no run.json "
                        "that says which of them its run has learned",
                        path.string()),
            "name one of the two files", usage_error);
    return is_there(formula) ? formula : network;
}

bool is_learned_policy(const std::filesystem::path& path) {
    const std::filesystem::path file = policy_file(path);
    const std::string ending = file.extension();
    return (ending == ".json" || ending == ".cgp" || ending == ".jsonl" || ending == ".txt" ||
            ending == solution_ending) &&
           is_there(file);
}

namespace {

// The actions of the episodes of a trace by their numbers. One that was over before its first step
// is not in the trace: its plan is empty.
class RecordedPlans {
  public:
    RecordedPlans(const rddl_problem& problem, std::string name)
        : problem_(problem), name_(std::move(name)) {}

    void begin_episode(std::int64_t number) {
        if (!numbers_.insert(number).second)
            fail(fmt::format("episode {} comes again after another one", number));
        if (number >= most_episodes) fail(fmt::format("it has an episode {}", number));
        plans_.resize(std::max(plans_.size(), static_cast<std::size_t>(number) + 1));
        plan_ = static_cast<std::size_t>(number);
    }
    void add(const TraceStep& step) {
        if (step.number >= longest_plan) fail(fmt::format("it has a step {}", step.number));
        const auto size = static_cast<std::size_t>(problem_.action_size);
        const auto* const none = static_cast<const std::byte*>(problem_.default_action);
        std::vector<std::byte>& plan = plans_[plan_];
        const std::size_t begin = static_cast<std::size_t>(step.number) * size;
        bytes_ += begin + size - plan.size();
        if (bytes_ > most_bytes) fail("its actions take more than 4 GB");
        while (plan.size() < begin) plan.insert(plan.end(), none, none + size);  // untold steps
        plan.insert(plan.end(), step.action.begin(), step.action.end());
        has_actions_ = true;
    }
    std::vector<std::vector<std::byte>> take() {
        if (!has_actions_) fail("it holds no actions");
        // One episode is a plan by itself, whatever its number was.
        if (numbers_.size() == 1) return {std::move(plans_.back())};
        return std::move(plans_);
    }

  private:
    static constexpr std::int64_t longest_plan = 10'000'000;  // steps
    static constexpr std::int64_t most_episodes = 10'000'000;
    static constexpr std::size_t most_bytes = std::size_t{1} << 32;

    [[noreturn]] void fail(const std::string& why) const {
        throw Failure(fmt::format("'{}' is not a plan: {}", name_, why));
    }

    const rddl_problem& problem_;
    std::string name_;
    std::vector<std::vector<std::byte>> plans_;
    std::set<std::int64_t> numbers_;
    std::size_t plan_ = 0, bytes_ = 0;
    bool has_actions_ = false;
};

solvers::Policy recorded_plans(const rddl_simulator& simulator, const std::filesystem::path& path) {
    UsedFiles used;
    LineReader lines(path.string(), used, longest_line(TraceFormat(*simulator.problem)));
    TraceSteps steps(simulator, {}, path.string());
    RecordedPlans plans(*simulator.problem, path.string());
    bool begins = true;
    while (const std::optional<std::string> line = lines.next()) {
        std::optional<TraceStep> step = steps.read(*line);
        if (steps.is_over()) {
            steps.begin_next();
            step = steps.read(*line);
            begins = true;
        }
        if (!step) continue;
        if (begins) plans.begin_episode(*steps.episode());
        begins = false;
        if (!step->action.empty()) plans.add(*step);
    }
    return solvers::plan_policy(simulator, path.string(), plans.take());
}

}  // namespace

solvers::Policy policy_of_text(const rddl_simulator& simulator, const std::string& text,
                               bool random, std::uint64_t seed, const std::string& name,
                               std::int64_t memory_limit) {
    if (solvers::is_program(text))
        return solvers::program_policy(simulator, solvers::read_program(simulator, text), name);
    return solvers::ppo_policy(simulator, solvers::read_ppo_policy(simulator, text, memory_limit),
                               random, seed, name);
}

solvers::Policy learned_policy(const rddl_simulator& simulator, const std::filesystem::path& path,
                               bool random, std::uint64_t seed, std::int64_t memory_limit) {
    const std::filesystem::path file = policy_file(path);
    if (file.extension() == ".jsonl") return recorded_plans(simulator, file);
    const std::string text = policy_text(path);
    try {
        if (file.extension() == solution_ending)
            return solution_policy(simulator, read_solution(simulator, text), path.string());
        return policy_of_text(simulator, text, random, seed, path.string(), memory_limit);
    } catch (const Failure& failure) {
        throw Failure(fmt::format("cannot act by '{}': {}", file.string(), failure.what()),
                      failure.hint);
    }
}

void note_plans(const solvers::Policy& policy, std::int64_t episodes) {
    if (policy.plans == 0 || policy.plans >= episodes) return;
    if (policy.plans == 1)
        tell("rddl: note: '{}' has one episode, which all {} play\n", policy.name, episodes);
    else
        tell("rddl: note: '{}' has {} episodes, which the {} play in turn\n", policy.name,
             policy.plans, episodes);
}

solvers::Policy policy_named(const rddl_simulator& simulator, const std::string& name, bool random,
                             std::uint64_t seed, std::int64_t memory_limit,
                             const PlannerSettings& planning) {
    if (planners::is_planner(name)) {
        planners::PolicySettings settings{seed, planning.cheat,   memory_limit,
                                          {},   planning.explain, planning.derivatives};
        settings.named = [&simulator, random, seed, memory_limit](const std::string& base) {
            return policy_named(simulator, base, random, seed, memory_limit);
        };
        return planners::planner_policy(simulator, name, settings);
    }
    if (name == "random") return solvers::random_policy(simulator, seed);
    if (name == "noop") return solvers::noop_policy(simulator);
    if (name == "rddl") {
        if (!simulator.policy)
            throw Failure("there is no policy block in the files of the problem",
                          "write it into one of them; commands that have --policy-block also take "
                          "a file of its own");
        return solvers::block_policy(simulator);
    }
    if (!is_there(name))
        throw Failure(fmt::format("'{}' is neither random, noop, rddl, a policy file, a trace, "
                                  "the folder of a run nor a planner (plan:NAME)",
                                  name),
                      {}, usage_error);
    if (is_block_file(name))
        throw Failure(fmt::format("'{}' holds a policy block, with which the problem has to be "
                                  "loaded",
                                  name),
                      "write the block into one of the problem's files, and name the policy "
                      "'rddl'; evaluate, compare and play also load it by --policy-block",
                      usage_error);
    return learned_policy(simulator, name, random, seed, memory_limit);
}

}  // namespace rddlc::workbench
