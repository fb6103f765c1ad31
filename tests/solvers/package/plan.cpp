// An episode of a planner, by the installed libraries.
#include "planners/planner/planner_policy.hpp"
#include "solvers/evaluation/episodes.hpp"

#include <planned_car.h>

#include <cstdio>

int main() {
    const rddl_simulator& simulator = *planned_car();
    const auto policy =
        rddlc::planners::planner_policy(simulator, "plan:cem,steps=2000,horizon=20", {});
    rddlc::solvers::EpisodeOptions options;
    options.horizon = 5;
    const auto rollouts = rddlc::solvers::run_episodes(simulator, policy, options, {});
    std::printf("planned %d steps\n", static_cast<int>(rollouts.steps));
    return rollouts.steps == 5 ? 0 : 1;
}
