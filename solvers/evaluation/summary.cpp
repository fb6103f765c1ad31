#include "solvers/evaluation/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rddlc::solvers {

// Cornish and Fisher's expansion (Abramowitz and Stegun 26.7.5) with exact values where it is poor.
double student_quantile(std::int64_t degrees_of_freedom) {
    constexpr double exact[] = {12.7062, 4.3027, 3.1824, 2.7764, 2.5706,
                                2.4469,  2.3646, 2.3060, 2.2622, 2.2281};
    if (degrees_of_freedom < 1) return 0;
    if (degrees_of_freedom <= 10) return exact[degrees_of_freedom - 1];
    const double x = 1.959963985, n = static_cast<double>(degrees_of_freedom);
    const double x3 = x * x * x, x5 = x3 * x * x, x7 = x5 * x * x;
    return x + (x3 + x) / (4 * n) + (5 * x5 + 16 * x3 + 3 * x) / (96 * n * n) +
           (3 * x7 + 19 * x5 + 17 * x3 - 15 * x) / (384 * n * n * n);
}

Estimate estimate_of(const std::vector<double>& values) {
    Estimate estimate;
    if (values.empty()) return estimate;
    const auto count = static_cast<double>(values.size());
    double sum = 0, squares = 0;
    for (const double value : values) sum += value;
    estimate.mean = sum / count;
    for (const double value : values) squares += (value - estimate.mean) * (value - estimate.mean);
    estimate.minimum = *std::min_element(values.begin(), values.end());
    estimate.maximum = *std::max_element(values.begin(), values.end());
    if (std::isnan(estimate.mean)) estimate.minimum = estimate.maximum = estimate.mean;
    if (estimate.minimum == estimate.maximum) {  // rounding shall not show a spread
        estimate.mean = estimate.minimum;
        return estimate;
    }
    estimate.deviation = std::sqrt(squares / (count - 1));
    estimate.half_width = student_quantile(static_cast<std::int64_t>(values.size()) - 1) *
                          estimate.deviation / std::sqrt(count);
    return estimate;
}

Summary summary_of(const Rollouts& rollouts) {
    Summary summary;
    std::vector<double> returns, discounted, lengths;
    for (const Episode& episode : rollouts.episodes) {
        if (!episode.finished) continue;
        returns.push_back(episode.undiscounted_return);
        discounted.push_back(episode.discounted_return);
        lengths.push_back(static_cast<double>(episode.length));
        summary.terminated += (episode.causes & RDDL_TERMINATED) != 0;
        summary.horizon += (episode.causes & RDDL_TRUNCATED_HORIZON) != 0;
        summary.invariant += (episode.causes & RDDL_TRUNCATED_INVARIANT) != 0;
        summary.faulted += (episode.causes & RDDL_FAULTED) != 0;
        summary.refused += episode.refused;
        summary.illegal_actions += episode.illegal_actions;
    }
    summary.episodes = static_cast<std::int64_t>(returns.size());
    summary.undiscounted_return = estimate_of(returns);
    summary.discounted_return = estimate_of(discounted);
    summary.length = estimate_of(lengths);
    return summary;
}

std::string what_is_not_finite(const Rollouts& rollouts) {
    for (std::size_t e = 0; e < rollouts.episodes.size(); ++e) {
        const Episode& episode = rollouts.episodes[e];
        if (episode.not_finite_step >= 0)
            return fmt::format("the reward of step {} of episode {} is not finite",
                               episode.not_finite_step, e);
        if (!std::isfinite(episode.undiscounted_return))
            return fmt::format("the rewards of episode {} add up to {}", e,
                               episode.undiscounted_return);
    }
    return "the returns add up to more than a number holds";
}

}  // namespace rddlc::solvers
