// A step of Adam, with its bias corrections (Kingma and Ba, 2015, algorithm 1).
#pragma once

#include "solvers/network/network.hpp"

#include <cmath>
#include <cstdint>
#include <span>

namespace rddlc::solvers {

struct AdamStep {
    std::int64_t number;  // from 1 on
    double learning_rate;
    double factor;  // of the gradient; less than 0 to go up
    float epsilon;
};

// All have the size of the parameters.
inline void take(const AdamStep& step, std::span<const float> gradient, std::span<float> first,
                 std::span<float> second, std::span<float> parameters) {
    const auto number = static_cast<double>(step.number);
    const double rate = step.learning_rate / (1 - std::pow(0.9, number));
    const double root = std::sqrt(1 - std::pow(0.999, number));
    network_functions().adam(gradient.size(), gradient.data(), static_cast<float>(step.factor),
                             static_cast<float>(rate), static_cast<float>(root), step.epsilon,
                             first.data(), second.data(), parameters.data());
}

}  // namespace rddlc::solvers
