// Generalised advantage estimation: J. Schulman et al., "High-dimensional continuous control using
// generalized advantage estimation", 2016, equation 16.
#pragma once

#include <cstddef>
#include <cstdint>

namespace rddlc::solvers {

// One environment's steps; element t of an array is at t * row.
struct Course {
    std::int64_t steps;
    std::ptrdiff_t row;
    const float* rewards;
    const float* values;  // of the states in which the steps began
    // The value of the state after a step with which an episode ended (0 if it terminated), and
    // after the last step. Other entries are not read.
    const float* next_values;
    const std::uint8_t* ends;  // 1: an episode ended with that step
};

// Writes the advantages, and the returns that values should estimate: advantage + value.
inline void estimate_advantages(const Course& course, double gamma, double lambda,
                                float* advantages, float* returns) {
    double advantage = 0;
    for (std::int64_t t = course.steps - 1; t >= 0; --t) {
        const std::ptrdiff_t at = t * course.row;
        const bool known = course.ends[at] || t == course.steps - 1;
        const double next =
            static_cast<double>(known ? course.next_values[at] : course.values[at + course.row]);
        const auto value = static_cast<double>(course.values[at]);
        const double error = static_cast<double>(course.rewards[at]) + gamma * next - value;
        advantage = error + (known ? 0 : gamma * lambda * advantage);
        advantages[at] = static_cast<float>(advantage);
        returns[at] = static_cast<float>(advantage + value);
    }
}

}  // namespace rddlc::solvers
