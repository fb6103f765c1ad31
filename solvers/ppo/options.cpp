#include "solvers/ppo/options.hpp"

namespace rddlc::solvers {

namespace {

PpoOptions without_help() {
    PpoOptions options;
    options.schedule = LearningRate::Constant;
    options.normalises_observations = options.normalises_rewards = false;
    options.noise = Noise::White;
    options.curious = false;
    options.observations.time = ObservationOptions::Time::Off;
    options.bootstraps = true;
    options.entropy_weight = 0;
    options.log_deviation = 0;
    return options;
}

PpoOptions sb3() {
    PpoOptions options = without_help();
    options.environments = 1;
    options.rollout = 2048;
    options.epochs = 10;
    options.minibatch = 64;
    return options;
}

PpoOptions rllib() {
    PpoOptions options = without_help();
    options.environments = 8;
    options.rollout = 500;
    options.epochs = 30;
    options.minibatch = 128;
    options.learning_rate = 5e-5;
    options.lambda = 1;
    options.clip = 0.3;
    options.value_clip = 10;
    options.value_weight = 1;
    options.gradient_norm = 0;
    options.kl_penalty = 0.2;
    options.hidden = {256, 256};
    return options;
}

}  // namespace

std::optional<PpoOptions> preset(std::string_view name) {
    if (name == "fast") return PpoOptions{};
    if (name == "sb3") return sb3();
    if (name == "rllib") return rllib();
    return std::nullopt;
}

}  // namespace rddlc::solvers
