#include "rollouts/evaluation.hpp"

#include "learning/learned_policy.hpp"
#include "learning/learning_curves.hpp"
#include "support/failure.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/progress.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace rddlc::workbench {

Evaluation evaluate(const rddl_simulator& simulator, const std::string& name,
                    const solvers::EpisodeOptions& options, bool random, bool quiet,
                    const PlannerSettings& planning) {
    const solvers::Policy policy =
        policy_named(simulator, name, random, options.seed, options.memory_limit, planning);
    if (!quiet) note_plans(policy, options.episodes);
    const std::int64_t steps = solvers::steps_at_most(simulator, options);
    Progress bar(name, options.episodes * std::max<std::int64_t>(steps, 1), !quiet);
    const solvers::Watch watch{is_interrupted, [&](std::int64_t done) { bar.advance(done); }, {}};
    const solvers::Rollouts rollouts = solvers::run_episodes(simulator, policy, options, watch);
    return {name, solvers::summary_of(rollouts), rollouts.seconds, rollouts.steps,
            rollouts.first_fault};
}

std::optional<double> learned_return(const std::string& policy) {
    try {
        const RunProgress run = read_progress(policy);
        const std::vector<double>& returns = column_of(run, "rollout/ep_rew_mean");
        if (!returns.empty() && std::isfinite(returns.back())) return returns.back();
    } catch (const Failure&) {
    }
    return std::nullopt;
}

}  // namespace rddlc::workbench
