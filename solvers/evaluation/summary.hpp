// Summaries of episodes: means with their confidence intervals.
#pragma once

#include "solvers/evaluation/episodes.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace rddlc::solvers {

struct Estimate {
    double mean = 0;
    double deviation = 0;  // of the sample, divided by n - 1; 0 for a single value
    double minimum = 0, maximum = 0;
    double half_width = 0;  // of the 95 % confidence interval of the mean, by Student's t
};
// Zeros for no values; nan if a value is nan.
Estimate estimate_of(const std::vector<double>& values);

struct Summary {
    Estimate undiscounted_return, discounted_return, length;
    std::int64_t episodes = 0;  // finished ones
    std::int64_t terminated = 0, horizon = 0, invariant = 0, faulted = 0, refused = 0;
    std::int64_t illegal_actions = 0;
};
Summary summary_of(const Rollouts& rollouts);

// The quantile 0.975 of Student's distribution.
double student_quantile(std::int64_t degrees_of_freedom);

// The first episode of which the return is not finite, in a sentence.
std::string what_is_not_finite(const Rollouts& rollouts);

}  // namespace rddlc::solvers
