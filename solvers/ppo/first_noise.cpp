#include "solvers/ppo/first_noise.hpp"

#include "solvers/evaluation/episodes.hpp"
#include "solvers/evaluation/summary.hpp"
#include "solvers/ppo/model.hpp"
#include "solvers/ppo/policy.hpp"

#include <cmath>
#include <memory>

namespace rddlc::solvers {

namespace {

constexpr std::int64_t episodes_of_noise = 8;
constexpr double worse_at_most = 10;  // times no-op's return
constexpr double careful = -2;

double mean_return(const rddl_simulator& simulator, const Policy& policy,
                   const PpoOptions& options) {
    EpisodeOptions episodes;
    episodes.episodes = episodes_of_noise;
    episodes.seed = options.seed;
    episodes.threads = options.threads;
    episodes.memory_limit = options.memory_limit;
    episodes.horizon = horizon_of_learners(*simulator.problem);
    Watch watch;
    watch.stops = options.stops;
    return summary_of(run_episodes(simulator, policy, episodes, watch)).undiscounted_return.mean;
}

}  // namespace

double first_log_deviation(const rddl_simulator& simulator, const ObservationSpace& observations,
                           const ActionSpace& actions, const PpoOptions& options) {
    if (actions.reals.empty()) return 0;
    const double noop = mean_return(simulator, noop_policy(simulator), options);
    if (noop == 0 || !std::isfinite(noop)) return 0;
    PpoOptions tried = options;
    tried.log_deviation = 0;
    const auto model = std::make_shared<PpoModel>(make_model(observations, actions, tried));
    const double noisy = mean_return(
        simulator, ppo_policy(simulator, model, true, options.seed, "untrained"), options);
    return noisy < noop - worse_at_most * std::abs(noop) ? careful : 0;
}

}  // namespace rddlc::solvers
