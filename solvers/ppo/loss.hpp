// The loss of PPO on some samples, and its gradient by the outputs of the networks.
#pragma once

#include "solvers/spaces/actions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

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

// What a row of logits says of the index that was chosen. Logits that were not allowed have no part
// in it. Adds to the gradient d: by_log_probability times that of the index's logarithm, and
// by_entropy times the entropy's.
template <class Real>
struct Category {
    Real log_probability = 0, entropy = 0;
};
template <class Real>
Category<Real> look_at_category(int count, const Real* logits, const std::uint8_t* mask,
                                int index) {
    Real most = -std::numeric_limits<Real>::infinity();
    for (int l = 0; l < count; ++l)
        if (!mask || mask[l]) most = std::max(most, logits[l]);
    Real sum = 0, weighted = 0;
    for (int l = 0; l < count; ++l) {
        if (mask && !mask[l]) continue;
        const Real above = logits[l] - most, weight = std::exp(above);
        sum += weight;
        weighted += weight * above;
    }
    const Real log_sum = std::log(sum);
    return {logits[index] - most - log_sum, log_sum - weighted / sum};
}
template <class Real>
void add_category_gradient(int count, const Real* logits, const std::uint8_t* mask, int index,
                           const Category<Real>& category, Real by_log_probability, Real by_entropy,
                           Real* d) {
    // ln p of a logit is the logit less this.
    const Real log_sum = logits[index] - category.log_probability;
    for (int l = 0; l < count; ++l) {
        if (mask && !mask[l]) continue;
        const Real log_p = logits[l] - log_sum, p = std::exp(log_p);
        d[l] += by_log_probability * ((l == index ? Real(1) : Real(0)) - p) -
                by_entropy * p * (log_p + category.entropy);
    }
}

// visit(count, logits, mask, index, d) for each category or pick of a sample. The last row may be
// NULL.
template <class Real, class Visit>
void for_each_category(const ActionSpace& space, const std::int32_t* indices,
                       const std::uint8_t* masks, const Real* logits, Real* d, Visit&& visit) {
    for (int p = 0; p < space.picks && indices[p] >= 0; ++p)
        visit(space.logit_count, logits, masks + p * space.logit_count, indices[p], d);
    for (std::size_t h = 0; h < space.categories.size(); ++h) {
        const CategoryHead& head = space.categories[h];
        visit(head.count, logits + head.first_logit, masks ? masks + head.first_logit : nullptr,
              indices[h], d ? d + head.first_logit : nullptr);
    }
}

// With picks a real counts where it was picked.
inline bool real_is_chosen(const ActionSpace& space, int real, const std::int32_t* indices) {
    if (space.picks == 0) return true;
    const int choice = space.reals[static_cast<std::size_t>(real)].choice;
    return std::find(indices, indices + space.picks, choice) != indices + space.picks;
}

// The logarithm of the probability (density) of what was chosen, and the entropy.
template <class Real>
Category<Real> look_at_choice(const ActionSpace& space, const Real* outputs,
                              const Real* log_deviations, const Real* numbers, const Real* shifts,
                              Real spread, const std::int32_t* indices, const std::uint8_t* masks) {
    Category<Real> all;
    const int reals = space.real_count();
    const Real log_spread = std::log(spread);
    for (int r = 0; r < reals; ++r) {
        if (!real_is_chosen(space, r, indices)) continue;
        const Real log_deviation = log_deviations[r] + log_spread;
        const Real z = (numbers[r] - outputs[r] - shifts[r]) * std::exp(-log_deviation);
        constexpr Real half_log_2pi = Real(0.91893853320467274178);
        all.log_probability -= Real(0.5) * z * z + log_deviation + half_log_2pi;
        all.entropy += Real(0.5) + half_log_2pi + log_deviation;
    }
    for_each_category<Real>(
        space, indices, masks, outputs + reals, nullptr,
        [&](int count, const Real* logits, const std::uint8_t* mask, int index, Real*) {
            const auto one = look_at_category(count, logits, mask, index);
            all.log_probability += one.log_probability;
            all.entropy += one.entropy;
        });
    return all;
}

// One sample's: writes the gradient by the policy's outputs, adds that by the logarithms of
// deviations.
template <class Real>
void choice_gradient(const ActionSpace& space, const Real* outputs, const Real* log_deviations,
                     const Real* numbers, const Real* shifts, Real spread,
                     const std::int32_t* indices, const std::uint8_t* masks,
                     Real by_log_probability, Real by_entropy, Real* d_outputs,
                     Real* d_log_deviations) {
    const int reals = space.real_count();
    std::fill(d_outputs, d_outputs + space.output_count(), Real(0));
    for (int r = 0; r < reals; ++r) {
        if (!real_is_chosen(space, r, indices)) continue;
        const Real per_deviation = std::exp(-log_deviations[r]) / spread;
        const Real z = (numbers[r] - outputs[r] - shifts[r]) * per_deviation;
        d_outputs[r] = by_log_probability * z * per_deviation;
        d_log_deviations[r] += by_log_probability * (z * z - 1) + by_entropy;
    }
    for_each_category<Real>(
        space, indices, masks, outputs + reals, d_outputs + reals,
        [&](int count, const Real* logits, const std::uint8_t* mask, int index, Real* d) {
            const auto one = look_at_category(count, logits, mask, index);
            add_category_gradient(count, logits, mask, index, one, by_log_probability, by_entropy,
                                  d);
        });
}

// `outputs` are rows of output_row numbers, as d_outputs; estimates, of values, and their gradient
// rows of value_row.
template <class Real>
void add_loss(const ActionSpace& space, const LossWeights& weights, const Samples<Real>& samples,
              int count, const Real* outputs, int output_row, const Real* log_deviations,
              const Real* estimates, int value_row, Real* d_outputs, Real* d_estimates,
              Real* d_log_deviations, LossSums& sums) {
    const int reals = space.real_count(), indices = space.index_count(), mask = space.mask_size();
    const auto weight = static_cast<Real>(weights.sample_weight);
    const auto clip = static_cast<Real>(weights.clip);
    for (int s = 0; s < count; ++s) {
        const Real* const output = outputs + s * output_row;
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

        // Of values: the estimate, or where it is clipped near to what it was.
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
