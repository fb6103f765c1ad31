// The loss of PPO on some samples, and its gradient by the outputs of the networks.
#pragma once

#include "solvers/action_distribution/probabilities.hpp"
#include "solvers/spaces/actions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace rddlc::solvers {

// Samples as rows, as they were chosen.
template <class Real>
struct Samples {
    const Real* numbers;          // real_count: the reals, as the learner numbers them
    const Real* shifts;           // real_count: by how much noise of the step before moved the mean
    const Real* spreads;          // 1: the part of the deviation that is noise of this step
    const std::int32_t* indices;  // index_count
    const std::uint8_t* masks;    // mask_size
    const Real* log_probabilities;  // 1, by the policy that chose
    const Real* advantages;         // 1
    const Real* values;             // 1, as they were estimated
    const Real* returns;            // 1
};

struct LossWeights {
    double clip, value_clip, value_weight, entropy_weight, kl_penalty;
    double advantage_mean, advantage_scale;  // advantages are (a - mean) * scale
    double sample_weight;                    // 1 / samples of the minibatch
};

// Sums over samples.
struct LossSums {
    double policy = 0, value = 0, entropy = 0, kl = 0, clipped = 0;
};

// `outputs` are rows of output_row numbers, as d_outputs; estimates, of values, and their gradient
// rows of value_row. Logarithms of deviations are rows of deviation_row numbers, or 0: one row for
// all; so is their gradient, to which is added. Samples with many sub-actions take long: it ends
// early where `stops` says so.
template <class Real>
void add_loss(const ActionSpace& space, const LossWeights& weights, const Samples<Real>& samples,
              int count, const Real* outputs, int output_row, const Real* all_log_deviations,
              int deviation_row, const Real* estimates, int value_row, Real* d_outputs,
              Real* d_estimates, Real* d_all_log_deviations, LossSums& sums,
              const Stops* stops = nullptr) {
    const int reals = space.real_count(), indices = space.index_count(), mask = space.mask_size();
    const auto weight = static_cast<Real>(weights.sample_weight);
    const auto clip = static_cast<Real>(weights.clip);
    for (int s = 0; s < count && !is_stopped(stops); ++s) {
        const Real* const output = outputs + s * output_row;
        const Real* const log_deviations = all_log_deviations + s * deviation_row;
        Real* const d_log_deviations = d_all_log_deviations + s * deviation_row;
        const Real* const number = samples.numbers + s * reals;
        const Real* const shift = samples.shifts + s * reals;
        const std::int32_t* const index = samples.indices + s * indices;
        const std::uint8_t* const allowed = mask > 0 ? samples.masks + s * mask : nullptr;
        const auto chosen = look_at_choice(space, output, log_deviations, number, shift,
                                           samples.spreads[s], index, allowed);
        const Real log_ratio = chosen.log_probability - samples.log_probabilities[s];
        const Real ratio = std::exp(log_ratio);
        const auto advantage = static_cast<Real>(
            (static_cast<double>(samples.advantages[s]) - weights.advantage_mean) *
            weights.advantage_scale);
        const Real unclipped = ratio * advantage;
        const Real clipped = std::clamp(ratio, 1 - clip, 1 + clip) * advantage;
        const bool counts = unclipped <= clipped;
        const Real by_log_probability = (counts ? -unclipped : Real(0)) * weight -
                                        static_cast<Real>(weights.kl_penalty) * weight;
        choice_gradient(space, output, log_deviations, number, shift, samples.spreads[s], index,
                        allowed, by_log_probability,
                        -static_cast<Real>(weights.entropy_weight) * weight,
                        d_outputs + s * output_row, d_log_deviations);

        // The value loss: from the estimate, or from the estimate clipped near its old value.
        const Real estimate = estimates[s * value_row];
        Real error = estimate - samples.returns[s];
        bool moves = true;
        if (weights.value_clip > 0) {
            const auto most = static_cast<Real>(weights.value_clip);
            const Real near =
                samples.values[s] + std::clamp(estimate - samples.values[s], -most, most);
            const Real other = near - samples.returns[s];
            if (other * other > error * error) {
                error = other;
                moves = near == estimate;
            }
        }
        d_estimates[s * value_row] =
            moves ? 2 * static_cast<Real>(weights.value_weight) * weight * error : Real(0);

        sums.policy -= static_cast<double>(std::min(unclipped, clipped));
        sums.value += static_cast<double>(error * error);
        sums.entropy += static_cast<double>(chosen.entropy);
        sums.kl += static_cast<double>(ratio - 1 - log_ratio);
        sums.clipped += std::abs(ratio - 1) > clip;
    }
}

}  // namespace rddlc::solvers
