// Problems that planners are tested with, and what they do there.
#pragma once

#include "engines/load_simulator.hpp"
#include "planner_coin.h"
#include "planner_ladder.h"
#include "planner_lock.h"
#include "planner_target.h"
#include "planner_tiger.h"
#include "planners/planner/planner_policy.hpp"
#include "solver_mountain_car.h"
#include "solver_network.h"
#include "solver_reservoir.h"
#include "solver_t_maze.h"
#include "solvers/evaluation/episodes.hpp"
#include "solvers/evaluation/summary.hpp"
#include "support/failure.hpp"
#include "support/memory.hpp"

#include <algorithm>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::planners {

inline const rddl_simulator& target() {
    return *rddl_simulator_target_target_1();
}
inline const rddl_simulator& coin() {
    return *rddl_simulator_coin_coin_1();
}
inline const rddl_simulator& ladder() {
    return *rddl_simulator_ladder_ladder_1();
}
inline const rddl_simulator& lock() {
    return *rddl_simulator_lock_lock_1();
}
inline const rddl_simulator& tiger() {
    return *rddl_simulator_tiger_tiger_1();
}
inline const rddl_simulator& car() {
    return *rddl_simulator_mountain_car_mountain_car_1();
}
inline const rddl_simulator& reservoir() {
    return *rddl_simulator_reservoir_reservoir_1();
}
inline const rddl_simulator& network() {
    return *rddl_simulator_network_network_1();
}
inline const rddl_simulator& maze() {
    return *rddl_simulator_t_maze_t_maze_1();
}

// No-op, with the values that the ladder has under the best policy (problems/ladder).
inline solvers::Policy policy_that_knows_the_ladder(const rddl_simulator& simulator) {
    solvers::Policy policy = solvers::noop_policy(simulator);
    policy.values = [&simulator](std::int64_t environments) -> solvers::StateValues {
        return [&simulator, environments](rddl_batch* batch, std::span<const std::int64_t> steps,
                                          double* values) {
            constexpr double known[5][4] = {
                {0, 0, 0, 0}, {0, 1, 2, 8}, {2, 2, 4, 8}, {3.5, 3.5, 6, 8}, {4.75, 4.75, 7, 8}};
            std::vector<double> seen(static_cast<std::size_t>(2 * environments));
            simulator.get_observation_values(batch, RDDL_DOUBLE, seen.data());
            for (std::size_t k = 0; k < steps.size(); ++k)
                values[k] = seen[2 * k + 1] != 0
                                ? 0
                                : known[4 - steps[k]][static_cast<std::size_t>(seen[2 * k])];
        };
    };
    return policy;
}

// One of tests/planners/problems.
inline workbench::LoadedProblem interpreted(const std::string& name) {
    workbench::ProblemFiles files;
    files.name = name;
    files.domain = PROBLEMS "/" + name + "/domain.rddl";
    files.instance = PROBLEMS "/" + name + "/instance.rddl";
    workbench::LoadOptions load;
    load.engine = workbench::Engine::Interpreter;
    return workbench::load_problem(files, load);
}

inline PolicySettings settings_of(const rddl_simulator& simulator) {
    PolicySettings settings;
    settings.named = [&simulator](const std::string& name) {
        if (name == "noop") return solvers::noop_policy(simulator);
        if (name == "random") return solvers::random_policy(simulator, 0);
        if (name == "fond of the last action") {
            solvers::Policy policy = solvers::noop_policy(simulator);
            policy.priors = [&simulator](std::int64_t, std::span<const std::byte> actions) {
                const auto count =
                    actions.size() / static_cast<std::size_t>(simulator.problem->action_size);
                return [count](rddl_batch*, std::span<const std::int64_t> steps, float* rows) {
                    for (std::size_t k = 0; k < steps.size() * count; ++k)
                        rows[k] = k % count == count - 1 ? 0.0f : -3.0f;
                };
            };
            return policy;
        }
        if (name == "knows the ladder") return policy_that_knows_the_ladder(simulator);
        if (name == "looks a step ahead") {
            solvers::Policy policy = policy_that_knows_the_ladder(simulator);
            policy.value_discount = 0;
            return policy;
        }
        throw Failure("there is no policy '" + name + "'");
    };
    return settings;
}

// The course of episodes 0, 1, ... of the seed.
struct Played {
    std::vector<solvers::Episode> episodes;
    solvers::Summary summary;
    std::map<std::pair<std::int64_t, std::int64_t>, Explanation>
        explanation;  // by episode and step

    double mean() const { return summary.undiscounted_return.mean; }
    const Explanation& thought(std::int64_t episode, std::int64_t step) const {
        return explanation.at({episode, step});
    }
    std::vector<double> returns() const {
        std::vector<double> all;
        for (const solvers::Episode& episode : episodes) all.push_back(episode.undiscounted_return);
        return all;
    }
};

inline Played run(const rddl_simulator& simulator, const std::string& planner,
                  std::int64_t episodes = 1, int threads = 1, std::uint64_t seed = 0,
                  const solvers::DerivativesSource& derivatives = {},
                  std::int64_t memory_limit = default_memory_limit, std::int64_t batch = 0) {
    Played plan;
    std::mutex mutex;
    PolicySettings settings = settings_of(simulator);
    settings.seed = seed;
    settings.derivatives = derivatives;
    settings.memory_limit = memory_limit;
    settings.explain = [&](const Explanation& explanation) {
        const std::scoped_lock lock(mutex);
        plan.explanation.insert_or_assign({explanation.episode, explanation.step}, explanation);
    };
    solvers::EpisodeOptions options;
    options.episodes = episodes;
    options.threads = threads;
    options.seed = seed;
    options.batch = batch;
    options.preconditions = solvers::Preconditions::Warn;  // so that they are counted
    const solvers::Policy policy = planner_policy(simulator, planner, settings);
    solvers::Rollouts rollouts = solvers::run_episodes(simulator, policy, options, {});
    plan.summary = solvers::summary_of(rollouts);
    plan.episodes = std::move(rollouts.episodes);
    return plan;
}

inline const std::byte* chosen_action(const Explanation& explanation) {
    return explanation.candidates.at(explanation.chosen).action.data();
}

}  // namespace rddlc::planners
