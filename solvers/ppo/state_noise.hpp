// Noise that depends on the state: A. Raffin, J. Kober, F. Stulp, "Smooth exploration for robotic
// reinforcement learning", 2021, as Stable-Baselines3 has it (gSDE).
//
// The noise of real j is the sum of h_i W_ij over the units of the policy's last hidden layer,
// where W_ij ~ N(0, exp(L_ij)^2) stays the same for some steps: equal states get equal noise. So it
// is normal with the variance sum of h_i^2 exp(2 L_ij). L is learned; nothing is learned of h by
// way of it.
#pragma once

#include "solvers/action_distribution/action_distribution.hpp"
#include "solvers/ppo/model.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

namespace rddlc::solvers {

// Rows of `units` x `reals` numbers: exp(2 L).
template <class Real>
void weight_variances(int units, int reals, const Real* logarithms, Real* variances) {
    for (int k = 0; k < units * reals; ++k) variances[k] = std::exp(2 * logarithms[k]);
}

// The logarithm of each real's deviation.
template <class Real>
void state_log_deviations(int units, int reals, const Real* variances, const Real* hidden,
                          Real* log_deviations) {
    for (int r = 0; r < reals; ++r) {
        Real sum = Real(1e-6);
        for (int u = 0; u < units; ++u) sum += hidden[u] * hidden[u] * variances[u * reals + r];
        log_deviations[r] = Real(0.5) * std::log(sum);
    }
}

// Adds to the gradient by L, given that by what the function above computes.
template <class Real>
void add_state_noise_gradient(int units, int reals, const Real* variances, const Real* hidden,
                              const Real* log_deviations, const Real* d_log_deviations,
                              Real* gradient) {
    for (int r = 0; r < reals; ++r) {
        const Real factor = d_log_deviations[r] * std::exp(-2 * log_deviations[r]);
        for (int u = 0; u < units; ++u)
            gradient[u * reals + r] += factor * hidden[u] * hidden[u] * variances[u * reals + r];
    }
}

// The weights W of some environments, and the noise that they make.
class StateNoise {
  public:
    StateNoise() = default;
    // The model must outlive this.
    StateNoise(const PpoModel& model, std::int64_t environments);

    bool is_used() const { return model_ != nullptr; }
    void begin_episode(std::int64_t environment);
    // Once for all environments, when the policy has changed.
    void look_at_policy();
    // The noise of the next step, given the hidden layer.
    void make(std::int64_t environment, const float* hidden, const ChoiceKey& key);
    // The deviations of all environments.
    Deviations deviations() const;

    template <class Archive>
    void archive(Archive& archive) {
        archive.fixed(normals_);
        archive.fixed(steps_left_);
    }

  private:
    const PpoModel* model_ = nullptr;
    std::vector<float> variances_;  // units x reals
    std::vector<float> normals_;    // for each environment units x reals, of which W is made
    std::vector<std::int32_t> steps_left_;
    std::vector<float> log_deviations_, noise_;  // rows of reals
};

// The place of the last hidden layer's results, in activations of `count` samples. Rows have
// hidden_row(network) numbers.
inline const float* last_hidden(const Network& network, const float* activations, int count) {
    return activations +
           network.layers[network.layers.size() - 2].values * static_cast<std::size_t>(count);
}
inline int hidden_row(const Network& network) {
    return network.layers[network.layers.size() - 2].padded_outputs;
}

}  // namespace rddlc::solvers
