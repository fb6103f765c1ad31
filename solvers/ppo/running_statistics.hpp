// Mean and variance of numbers that come in batches: T. Chan, G. Golub, R. LeVeque, "Updating
// formulae and a pairwise algorithm for computing sample variances", 1979.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace rddlc::solvers {

// Sums of how far `count` numbers are from a fixed origin, and of the squares.
struct Moments {
    double count = 0, sum = 0, squares = 0;
    void add(double distance) {
        count += 1;
        sum += distance;
        squares += distance * distance;
    }
    void add(const Moments& others) {
        count += others.count;
        sum += others.sum;
        squares += others.squares;
    }
};

// Numbers below this are far below the usual ones: by 100 times the distance between the 5th and
// the 95th of a hundred. -inf where these are the same. Changes the order of the numbers.
inline double least_usual(std::span<float> numbers) {
    const auto at = [&](std::size_t place) {
        const auto found = numbers.begin() + static_cast<std::ptrdiff_t>(place);
        std::nth_element(numbers.begin(), found, numbers.end());
        return static_cast<double>(*found);
    };
    const std::size_t part = numbers.size() / 20;
    const double low = at(part), high = at(numbers.size() - 1 - part);
    return high > low ? low - 100 * (high - low) : -std::numeric_limits<double>::infinity();
}

struct RunningStatistics {
    double count = 0, mean = 0, variance = 1;

    // Moments about the mean as it is.
    void add(const Moments& batch) {
        if (batch.count == 0) return;
        const double all = count + batch.count, moved = batch.sum / batch.count;
        const double own = batch.squares - batch.sum * moved;  // about the batch's own mean
        const double old = count > 0 ? variance * count : 0;
        variance = (old + own + moved * moved * count * batch.count / all) / all;
        mean += moved * batch.count / all;
        count = all;
    }
    double deviation() const { return std::sqrt(variance + 1e-8); }
};

// Numbers become (x - mean) / deviation, within +-10.
struct Normaliser {
    static constexpr float most = 10;
    std::vector<float> means, factors;  // of each feature; 0 and 1 at first
    explicit Normaliser(int features = 0)
        : means(static_cast<std::size_t>(features), 0.0f),
          factors(static_cast<std::size_t>(features), 1.0f) {}

    void write(const float* features, float* normalised) const {
        for (std::size_t f = 0; f < means.size(); ++f) {
            const float x = (features[f] - means[f]) * factors[f];
            normalised[f] = x > most ? most : x < -most ? -most : x;
        }
    }
};

}  // namespace rddlc::solvers
