// How likely a choice is, by the outputs of a policy's network, and the gradient of that.
#pragma once

#include "solvers/spaces/actions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace rddlc::solvers {

// The log-probability of the chosen index and the entropy, from a row of logits. Logits that were
// not allowed have no part in it. Adds to the gradient d: by_log_probability times that of the
// index's logarithm, and by_entropy times the entropy's.
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

// visit(count, logits, mask, index, d) for each category or sub-action of a sample. The last row
// may be NULL.
template <class Real, class Visit>
void for_each_category(const ActionSpace& space, const std::int32_t* indices,
                       const std::uint8_t* masks, const Real* logits, Real* d, Visit&& visit) {
    for (int p = 0; p < space.max_sub_actions && indices[p] >= 0; ++p)
        visit(space.logit_count, logits, masks + p * space.logit_count, indices[p], d);
    for (std::size_t h = 0; h < space.categories.size(); ++h) {
        const CategoryHead& head = space.categories[h];
        visit(head.count, logits + head.first_logit, masks ? masks + head.first_logit : nullptr,
              indices[h], d ? d + head.first_logit : nullptr);
    }
}

// ln(1 - tanh(u)^2), also where tanh(u) rounds to 1.
template <class Real>
Real log_squash_slope(Real u) {
    constexpr Real ln2 = Real(0.69314718055994530942);
    return 2 * (ln2 - std::abs(u) - std::log1p(std::exp(-2 * std::abs(u))));
}

// The mean of that over u ~ N(mean, deviation^2), which squashing adds to the entropy, and its
// derivatives: by Gauss and Hermite's rule of seven points.
template <class Real>
struct SquashEntropy {
    Real value = 0, by_mean = 0, by_log_deviation = 0;
};
template <class Real>
SquashEntropy<Real> squash_entropy(Real mean, Real deviation) {
    constexpr double points[] = {0, 1.1544053947399682, 2.3667594107345415, 3.7504397177257425};
    constexpr double weights[] = {0.45714285714285714, 0.24012317860501271, 0.030757123967586498,
                                  0.00054826885597221875};
    SquashEntropy<Real> sum;
    for (int p = -3; p <= 3; ++p) {
        const auto weight = static_cast<Real>(weights[std::abs(p)]);
        const Real z = static_cast<Real>(points[std::abs(p)]) * (p < 0 ? Real(-1) : Real(1));
        const Real u = mean + deviation * z;
        const Real slope = -2 * std::tanh(u) * weight;
        sum.value += weight * log_squash_slope(u);
        sum.by_mean += slope;
        sum.by_log_deviation += slope * deviation * z;
    }
    return sum;
}

inline bool is_squashed(const ActionSpace& space, int real) {
    return space.reals[static_cast<std::size_t>(real)].range == RealHead::Range::Squashed;
}

// A space with sub-actions uses a real only where one of them chose it.
inline bool real_is_chosen(const ActionSpace& space, int real, const std::int32_t* indices) {
    if (space.max_sub_actions == 0) return true;
    const int choice = space.reals[static_cast<std::size_t>(real)].choice;
    return std::find(indices, indices + space.max_sub_actions, choice) !=
           indices + space.max_sub_actions;
}

// The logarithm of the probability (density) of what was chosen, and the entropy.
template <class Real>
Category<Real> look_at_choice(const ActionSpace& space, const Real* outputs,
                              const Real* log_deviations, const Real* numbers, const Real* shifts,
                              Real spread, const std::int32_t* indices, const std::uint8_t* masks) {
    Category<Real> all;
    const int reals = space.real_count();
    const Real log_spread = spread == 1 ? Real(0) : std::log(spread);
    for (int r = 0; r < reals; ++r) {
        if (!real_is_chosen(space, r, indices)) continue;
        const Real log_deviation = log_deviations[r] + log_spread;
        const Real z = (numbers[r] - outputs[r] - shifts[r]) * std::exp(-log_deviation);
        constexpr Real half_log_2pi = Real(0.91893853320467274178);
        all.log_probability -= Real(0.5) * z * z + log_deviation + half_log_2pi;
        all.entropy += Real(0.5) + half_log_2pi + log_deviation;
        if (!is_squashed(space, r)) continue;
        all.log_probability -= log_squash_slope(numbers[r]);
        all.entropy += squash_entropy(outputs[r] + shifts[r], std::exp(log_deviation)).value;
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
        if (!is_squashed(space, r) || by_entropy == 0) continue;
        const auto squash = squash_entropy(outputs[r] + shifts[r], 1 / per_deviation);
        d_outputs[r] += by_entropy * squash.by_mean;
        d_log_deviations[r] += by_entropy * squash.by_log_deviation;
    }
    for_each_category<Real>(
        space, indices, masks, outputs + reals, d_outputs + reals,
        [&](int count, const Real* logits, const std::uint8_t* mask, int index, Real* d) {
            const auto one = look_at_category(count, logits, mask, index);
            add_category_gradient(count, logits, mask, index, one, by_log_probability, by_entropy,
                                  d);
        });
}

}  // namespace rddlc::solvers
