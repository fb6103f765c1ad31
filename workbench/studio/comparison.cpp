#include "studio/comparison.hpp"

#include "formats/records_json.hpp"
#include "learning/learned_policy.hpp"
#include "solvers/evaluation/episodes.hpp"
#include "solvers/evaluation/summary.hpp"
#include "solvers/spaces/refusals.hpp"
#include "studio/policy_name.hpp"
#include "support/failure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <vector>

namespace rddlc::studio {

using namespace workbench;

namespace {

Json estimate_json(const solvers::Estimate& e) {
    return {{"mean", json_number(e.mean)},
            {"half_width_95", json_number(e.half_width)},
            {"min", json_number(e.minimum)},
            {"max", json_number(e.maximum)}};
}

Json policy_json(const std::string& name, const solvers::Rollouts& rollouts) {
    const solvers::Summary summary = solvers::summary_of(rollouts);
    Json returns = Json::array();
    for (const solvers::Episode& episode : rollouts.episodes)
        if (episode.finished) returns.push_back(json_number(episode.undiscounted_return));
    return {{"policy", name},
            {"episodes", summary.episodes},
            {"return", estimate_json(summary.undiscounted_return)},
            {"discounted_return", estimate_json(summary.discounted_return)},
            {"length", estimate_json(summary.length)},
            {"terminated", summary.terminated},
            {"illegal_actions", summary.illegal_actions},
            {"faulted", summary.faulted},
            {"returns", returns}};
}

solvers::Rollouts episodes_of(Job& job, const LoadedProblem& problem, const std::string& policy,
                              const ComparisonOptions& options) {
    const rddl_simulator& simulator = *problem.simulator;
    solvers::EpisodeOptions episodes;
    episodes.episodes = options.episodes;
    episodes.seed = options.seed;
    episodes.memory_limit = problem.files.memory_limit;
    episodes.preconditions = solvers::Preconditions::Warn;  // so that they are counted
    if (options.horizon > 0) episodes.horizon = options.horizon;
    const auto longest = std::max<std::int64_t>(solvers::steps_at_most(simulator, episodes), 1);
    // The product may be larger than an integer.
    const double all = static_cast<double>(options.episodes) * static_cast<double>(longest);
    std::atomic<std::int64_t> done = 0;
    const auto advance = [&](std::int64_t steps) {
        const double part = static_cast<double>(done += steps) / all;
        job.report({{"policy", policy}, {"part", std::min(part, 1.0)}});
    };
    job.report({{"policy", policy}, {"part", 0}});
    return solvers::run_episodes(
        simulator,
        policy_named(simulator, name_when_loaded(policy), false, options.seed,
                     problem.files.memory_limit, {.derivatives = problem.derivatives}),
        episodes, {[&job] { return job.stops(); }, advance, {}});
}

// The pairs of episodes that both policies have finished.
std::vector<double> differences(const solvers::Rollouts& a, const solvers::Rollouts& b) {
    std::vector<double> all;
    for (std::size_t e = 0; e < std::min(a.episodes.size(), b.episodes.size()); ++e)
        if (a.episodes[e].finished && b.episodes[e].finished)
            all.push_back(b.episodes[e].undiscounted_return - a.episodes[e].undiscounted_return);
    return all;
}

}  // namespace

Json compare(Job& job, const std::array<LoadedProblem, 2>& problems,
             const ComparisonOptions& options) {
    const rddl_problem& described = *problems[0].simulator->problem;
    if (solvers::is_endless(described, options.horizon > 0 ? options.horizon : described.horizon))
        throw Failure(solvers::endless, "give the episodes a number of steps");
    const solvers::Rollouts first = episodes_of(job, problems[0], options.policies[0], options);
    const solvers::Rollouts second = episodes_of(job, problems[1], options.policies[1], options);
    const std::vector<double> paired = differences(first, second);
    return {{"seed", options.seed},
            {"policies", Json::array({policy_json(options.policies[0], first),
                                      policy_json(options.policies[1], second)})},
            {"pairs", paired.size()},
            {"difference", estimate_json(solvers::estimate_of(paired))}};
}

}  // namespace rddlc::studio
