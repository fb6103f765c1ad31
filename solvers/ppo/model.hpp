// What PPO learns: the networks of policy and values, and what the policy needs beside them.
#pragma once

#include "solvers/network/network.hpp"
#include "solvers/ppo/options.hpp"
#include "solvers/ppo/running_statistics.hpp"
#include "solvers/spaces/actions.hpp"
#include "solvers/spaces/observations.hpp"

#include <cstdint>
#include <vector>

namespace rddlc::solvers {

struct PpoModel {
    ObservationSpace observations;
    ActionSpace actions;
    Noise noise = Noise::Ar1;
    double correlation = 0;
    std::vector<int> hidden;
    Network policy, value;
    Normaliser normaliser{0};
    // The policy's, the value's, and the logarithms of the reals' deviations.
    std::vector<float> parameters;

    std::size_t value_begin() const { return policy.parameters; }
    std::size_t deviations_begin() const { return policy.parameters + value.parameters; }
    const float* value_parameters() const { return parameters.data() + value_begin(); }
    const float* log_deviations() const { return parameters.data() + deviations_begin(); }
    // The best that one step of the environment can be told: rows of features.
    int features() const { return observations.feature_count(); }
};

// With orthogonal weights (A. Saxe et al., 2014): of gain sqrt(2) in hidden layers, 0.01 in the
// policy's last and 1 in the value's last one.
PpoModel make_model(const ObservationSpace& observations, const ActionSpace& actions,
                    const PpoOptions& options);

// Room for the networks, once the spaces and `hidden` are there; all parameters are 0.
void make_networks(PpoModel& model);

}  // namespace rddlc::solvers
