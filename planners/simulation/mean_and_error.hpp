// Means of returns, with their standard errors.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

namespace rddlc::planners {

struct MeanAndError {
    double mean, error;
};

// The mean and its error of the numbers at(0), at(1), ...; the mean is -inf if a number is not
// finite.
MeanAndError mean_and_error(std::size_t count, const auto& at) {
    double sum = 0, squares = 0;
    for (std::size_t k = 0; k < count; ++k) sum += at(k);
    const double n = static_cast<double>(count), mean = sum / n;
    if (!std::isfinite(mean)) return {-std::numeric_limits<double>::infinity(), 0};
    for (std::size_t k = 0; k < count; ++k) squares += (at(k) - mean) * (at(k) - mean);
    return {mean, count > 1 ? std::sqrt(squares / (n - 1) / n) : 0};
}

}  // namespace rddlc::planners
