// The options of PPO: J. Schulman et al., "Proximal policy optimization algorithms", 2017, with the
// details of S. Huang et al., "The 37 implementation details of PPO", 2022.
#pragma once

#include "solvers/action_distribution/action_distribution.hpp"
#include "solvers/network/network.hpp"
#include "solvers/spaces/observations.hpp"
#include "support/memory.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::solvers {

enum class LearningRate { Constant, Linear, Kl };  // Kl: changed so that the policy moves evenly

struct PpoOptions {
    std::int64_t steps = 1'000'000;  // of all environments together
    int environments = 64;
    int rollout = 128;              // steps of each environment between updates
    bool names_rollout = false;     // somebody has chosen these two
    bool shortens_rollout = false;  // where it does not fit into memory_limit
    int epochs = 4;
    int minibatch = 1024;  // samples
    double learning_rate = 3e-4;
    LearningRate schedule = LearningRate::Linear;  // Linear: down to 0
    double gamma = 0.99;        // discount; never above the instance's where that is below 1
    double lambda = 0.95;       // of generalised advantage estimation
    double clip = 0.2;          // of the probability ratio
    double value_clip = 0;      // 0: no clipping
    double value_weight = 0.5;  // of the squared error of values
    std::optional<double> entropy_weight;  // absent: 0, or 0.01 with categories or sub-actions
    double gradient_norm = 0.5;            // at most; 0: any
    double kl_stop = 0;     // an update ends when the policy has moved by 1.5 times this; 0: never
    double kl_penalty = 0;  // weight of the divergence in the loss, which adapts itself to
    double kl_target = 0.01;  // this divergence, as schedule Kl does
    bool normalises_observations = true, normalises_rewards = true;
    bool normalises_advantages = true;
    Noise noise = Noise::Ar1;
    double correlation = 0.9;  // of Ar1, between a step and the next
    int noise_steps = 8;       // of Sde, with the same weights
    // The first noise; absent: 0, or less where that would be ruinous (first_noise.hpp).
    std::optional<double> log_deviation;
    bool squashes = false;  // reals with two bounds are tanh of a normal number, not cut
    // Rewards seeing more of the problem while nearly all episodes have the same return
    // (curiosity.hpp).
    bool curious = true;
    std::vector<int> hidden = {64, 64};        // of the policy's network, and of the values'
    Activation activation = Activation::Tanh;  // of hidden layers
    // Units that remember, which both networks see beside the observation; 0: no memory. The
    // gradient goes back through as many steps as a segment has at most.
    int recurrent = 0;
    int segment = 32;
    ObservationOptions observations;
    // Whether the value after the horizon is estimated; absent: unless the policy sees the time,
    // when the horizon is a fact of the problem and no accident.
    std::optional<bool> bootstraps;
    std::uint64_t seed = 0;
    int threads = 1;
    std::int64_t memory_limit =
        default_memory_limit;  // bytes of all that it takes (memory_estimate.hpp)
    // All threads call it often: whether an update shall end early. Its results are then not those
    // of a complete run. May be empty.
    std::function<bool()> stops;
};

// Steps of a segment at most: 1 where nothing is remembered.
inline int longest_segment(const PpoOptions& options) {
    if (options.recurrent == 0) return 1;
    return std::min({options.segment, options.rollout, options.minibatch});
}

inline std::size_t segments_per_minibatch(const PpoOptions& options) {
    return static_cast<std::size_t>(options.minibatch / longest_segment(options));
}

// "fast" (the defaults), "sb3" (Stable-Baselines3's defaults), "rllib" (RLlib's). Returns nothing
// if no preset has this name.
std::optional<PpoOptions> preset(std::string_view name);

}  // namespace rddlc::solvers
