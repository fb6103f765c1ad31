// The model of PPO: the networks of policy and values, and the numbers that the policy needs beside
// them.
#pragma once

#include "solvers/network/gru.hpp"
#include "solvers/network/network.hpp"
#include "solvers/ppo/options.hpp"
#include "solvers/ppo/running_statistics.hpp"
#include "solvers/spaces/actions.hpp"
#include "solvers/spaces/observations.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace rddlc::solvers {

struct PpoModel {
    std::string solver = "ppo";  // the learner; "drp" trains no values
    ObservationSpace observations;
    ActionSpace actions;
    Noise noise = Noise::Ar1;
    double correlation = 0;  // of Ar1
    int noise_steps = 8;     // with the same weights, of Sde
    std::vector<int> hidden;
    Activation activation = Activation::Tanh;  // of hidden layers
    int recurrent = 0;                         // units that remember; 0: no memory
    // Both networks see a row of features and then what is remembered, this row's features
    // included.
    Network policy, value;
    Gru memory;  // sees the features
    Normaliser normaliser{0};
    // Values estimate the sum of later rewards / value_scale by the discount value_discount; 0: the
    // scale is not known, and they mean nothing to others than the training.
    double value_scale = 0, value_discount = 1;
    // The policy's, the value's, the logarithms of the reals' deviations (those of noise that
    // depends on the state for each of noisy_units()), and the memory's.
    std::vector<float> parameters;

    std::size_t value_begin() const { return policy.parameters; }
    std::size_t deviations_begin() const { return policy.parameters + value.parameters; }
    const float* value_parameters() const { return parameters.data() + value_begin(); }
    const float* log_deviations() const { return parameters.data() + deviations_begin(); }
    // Units of the last hidden layer if the noise depends on the state; else 0.
    int noisy_units() const {
        return noise == Noise::Sde && actions.real_count() > 0 ? hidden.back() : 0;
    }
    int deviation_count() const { return actions.real_count() * std::max(noisy_units(), 1); }
    std::size_t memory_begin() const {
        return deviations_begin() +
               static_cast<std::size_t>(padded(std::max(deviation_count(), 1)));
    }
    const float* memory_parameters() const { return parameters.data() + memory_begin(); }
    // Features in a row of observations.
    int features() const { return observations.feature_count(); }
    // Numbers from a row of the networks' inputs to the next.
    int input_row() const { return features() + memory.padded_units; }
};

// Makes a model with orthogonal weights (A. Saxe et al., 2014): of gain sqrt(2) in hidden layers,
// 0.01 in the policy's last, 1 in the value's last one and in the memory, whose bias of z is 1: at
// first it forgets slowly (R. Jozefowicz et al., 2015).
PpoModel make_model(const ObservationSpace& observations, const ActionSpace& actions,
                    const PpoOptions& options);

// The same in two steps: first the networks' layout, which takes no memory yet, and then their
// parameters. Only some parameters are made if options.stops says so.
PpoModel model_without_parameters(const ObservationSpace& observations, const ActionSpace& actions,
                                  const PpoOptions& options);
void make_parameters(PpoModel& model, const PpoOptions& options);
// How many there are, or will be.
std::size_t parameter_count(const PpoModel& model);

// Lays out the networks, once the spaces and all sizes are there; it allocates no parameters yet.
void lay_out_networks(PpoModel& model);

// Room for the networks, once the spaces and all that says what they are is there; all parameters
// are 0.
void make_networks(PpoModel& model);

}  // namespace rddlc::solvers
