// Episodes of another policy, such as a planner, that PPO imitates before it learns by itself:
// behaviour cloning (D. Pomerleau, "ALVINN: an autonomous land vehicle in a neural network", 1988).
#pragma once

#include "solvers/evaluation/episodes.hpp"
#include "solvers/evaluation/summary.hpp"
#include "solvers/policies/policy.hpp"
#include "solvers/ppo/model.hpp"

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace rddlc::solvers {

// Steps, one after the other, episode by episode.
struct Demonstrations {
    std::vector<float> features;        // rows of the model's features, as they are
    std::vector<float> actions;         // rows of action values
    std::vector<double> rewards;        // of each step
    std::vector<std::uint8_t> is_last;  // of its episode
    Estimate returns;                   // of the episodes

    std::size_t count() const { return rewards.size(); }
};

// Plays the episodes of `options`, watched without a record. Steps that fault are left out. Throws
// a Failure where a reward is not finite, or nothing was played.
Demonstrations demonstrations(const rddl_simulator& simulator, const PpoModel& model,
                              const Policy& policy, const EpisodeOptions& options, Watch watch);

// Makes them for a model, whose features they have.
using Demonstrate = std::function<Demonstrations(const PpoModel& model)>;

}  // namespace rddlc::solvers
