#include "learning/learned_policy.hpp"

#include "formats/line_stream.hpp"
#include "formats/trace.hpp"
#include "formats/trace_steps.hpp"
#include "solvers/cgp/policy_file.hpp"
#include "solvers/ppo/policy_file.hpp"
#include "support/failure.hpp"
#include "support/files.hpp"

#include <fmt/format.h>

namespace rddlc::cli {

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
        throw Failure(fmt::format("there is no policy in the folder '{}'", path.string()),
                      "'rddl train' writes policy.json or policy.cgp into the folder of a run",
                      usage_error);
    return read_file(file, largest_policy);
}

std::filesystem::path policy_file(const std::filesystem::path& path) {
    if (!is_folder(path)) return path;
    const std::filesystem::path formula = path / "policy.cgp";
    return is_there(formula) ? formula : path / "policy.json";
}

bool is_learned_policy(const std::filesystem::path& path) {
    const std::filesystem::path file = policy_file(path);
    const std::string ending = file.extension();
    return (ending == ".json" || ending == ".cgp" || ending == ".jsonl" || ending == ".txt") &&
           is_there(file);
}

namespace {

constexpr std::int64_t longest_plan = 10'000'000;  // steps

// The actions of the first episode of a trace.
solvers::Policy recorded_plan(const rddl_simulator& simulator, const std::filesystem::path& path) {
    const rddl_problem& problem = *simulator.problem;
    UsedFiles used;
    LineReader lines(path.string(), used, longest_line(TraceFormat(problem)));
    TraceSteps steps(simulator, {}, path.string());
    const auto* const none = static_cast<const std::byte*>(problem.default_action);
    std::vector<std::byte> actions;
    while (const std::optional<std::string> line = lines.next()) {
        const std::optional<TraceStep> step = steps.read(*line);
        if (steps.is_over()) break;
        if (!step || step->action.empty()) continue;
        if (step->number >= longest_plan)
            throw Failure(
                fmt::format("'{}' is no plan: it has a step {}", path.string(), step->number));
        const auto size = static_cast<std::size_t>(problem.action_size);
        while (actions.size() < static_cast<std::size_t>(step->number) * size)
            actions.insert(actions.end(), none, none + size);  // steps that are not told
        actions.insert(actions.end(), step->action.begin(), step->action.end());
    }
    if (actions.empty())
        throw Failure(fmt::format("'{}' is no plan: there is no action in it", path.string()));
    return solvers::plan_policy(simulator, path.string(), std::move(actions));
}

}  // namespace

solvers::Policy policy_of_text(const rddl_simulator& simulator, const std::string& text,
                               bool random, std::uint64_t seed, const std::string& name) {
    if (solvers::is_program(text))
        return solvers::program_policy(simulator, solvers::read_program(simulator, text), name);
    return solvers::ppo_policy(simulator, solvers::read_ppo_policy(simulator, text), random, seed,
                               name);
}

solvers::Policy learned_policy(const rddl_simulator& simulator, const std::filesystem::path& path,
                               bool random, std::uint64_t seed) {
    const std::filesystem::path file = policy_file(path);
    if (file.extension() == ".jsonl") return recorded_plan(simulator, file);
    const std::string text = policy_text(path);
    try {
        return policy_of_text(simulator, text, random, seed, path.string());
    } catch (const Failure& failure) {
        throw Failure(fmt::format("cannot act by '{}': {}", file.string(), failure.what()));
    }
}

solvers::Policy policy_named(const rddl_simulator& simulator, const std::string& name, bool random,
                             std::uint64_t seed) {
    if (name == "random") return solvers::random_policy(simulator, seed);
    if (name == "noop") return solvers::noop_policy(simulator);
    if (name == "rddl") {
        if (!simulator.policy)
            throw Failure("there is no policy block in the files of the problem",
                          "name the file that has it: --policy-block=FILE.rddl");
        return solvers::block_policy(simulator);
    }
    if (!is_there(name))
        throw Failure(fmt::format("'{}' is neither random, noop, rddl, a policy file, a trace nor "
                                  "the folder of a run",
                                  name),
                      {}, usage_error);
    return learned_policy(simulator, name, random, seed);
}

}  // namespace rddlc::cli
