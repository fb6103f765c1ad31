// How well draws fit a law. A test fails a correct sampler with probability below 1e-6 for a
// fresh seed; the seeds are fixed, so that a test that passes once passes always.
#pragma once

#include <rddl/random/random.hpp>

#include <boost/math/distributions/chi_squared.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

namespace rddl::fit {

inline constexpr double false_alarm_rate = 1e-6;
inline constexpr int draw_count = 100000;

// Draws at different indices of one step. `draw(context, place)` is a call of a kernel.
template <class Draw>
auto draws_of(Draw draw, std::uint64_t seed = 1) {
    Context<Scalar> context{stream_key(seed, 0, 0), 1, {}};
    std::vector<decltype(draw(context, Place{}))> draws;
    for (int i = 0; i < draw_count; ++i) draws.push_back(draw(context, Place{0, i}));
    EXPECT_FALSE(context.fault);
    return draws;
}

// Calls test(a, b) for each pair of parameters.
template <class Test>
void with_each(std::initializer_list<std::pair<double, double>> parameters, Test test) {
    for (const auto& [a, b] : parameters) {
        SCOPED_TRACE(testing::Message() << "parameters " << a << ", " << b);
        test(a, b);
    }
}

// Pearson's statistic of observed and expected counts against its distribution.
inline void expect_counts_fit(const std::vector<double>& observed,
                              const std::vector<double>& expected) {
    double statistic = 0;
    for (std::size_t i = 0; i < observed.size(); ++i) {
        const double difference = observed[i] - expected[i];
        statistic += difference * difference / expected[i];
    }
    if (observed.size() < 2) return;
    const boost::math::chi_squared law(static_cast<double>(observed.size() - 1));
    EXPECT_LE(statistic, quantile(complement(law, false_alarm_rate)))
        << "over " << observed.size() << " classes";
}

// Kolmogorov and Smirnov's distance, and Pearson's statistic over classes that reach into both
// tails (10 draws of 100000 are expected in the outermost), which the distance hardly sees.
template <class Distribution>
void expect_continuous_fit(std::vector<double> draws, Distribution cdf) {
    std::sort(draws.begin(), draws.end());
    const double n = static_cast<double>(draws.size());
    const std::vector<double> cuts{1e-4, 1e-3, 0.01, 0.1,   0.3,    0.5,
                                   0.7,  0.9,  0.99, 0.999, 0.9999, 1.0};
    std::vector<double> observed(cuts.size(), 0.0), expected(cuts.size());
    double distance = 0;
    for (std::size_t i = 0; i < draws.size(); ++i) {
        const double p = cdf(draws[i]);
        const double before = static_cast<double>(i) / n;
        distance = std::max({distance, p - before, before + 1 / n - p});
        const auto place = std::lower_bound(cuts.begin(), cuts.end(), p) - cuts.begin();
        observed[static_cast<std::size_t>(place)] += 1;
    }
    for (std::size_t i = 0; i < cuts.size(); ++i)
        expected[i] = n * (cuts[i] - (i == 0 ? 0.0 : cuts[i - 1]));
    EXPECT_LE(distance, std::sqrt(-0.5 * std::log(false_alarm_rate / 2) / n));
    expect_counts_fit(observed, expected);
}

// The least count that is not exceeded with probability `level`.
template <class Distribution>
std::int64_t count_at(double level, Distribution cdf) {
    std::int64_t above = 1;
    while (cdf(above) < level) above *= 2;
    std::int64_t below = -1;
    while (above - below > 1) {
        const std::int64_t middle = below + (above - below) / 2;
        (cdf(middle) < level ? below : above) = middle;
    }
    return above;
}

// Pearson's statistic of counts, over 50 classes of about equal probability and finer ones in the
// tails. `cdf(k)` is the probability of at most k.
template <class Distribution>
void expect_count_fit(std::vector<std::int64_t> draws, Distribution cdf) {
    std::vector<double> levels{1e-4, 1e-3, 5e-3};
    for (int i = 1; i < 50; ++i) levels.push_back(0.02 * i);
    levels.insert(levels.end(), {0.995, 0.999, 0.9999});

    std::sort(draws.begin(), draws.end());
    const double n = static_cast<double>(draws.size());
    std::vector<double> observed, expected;
    double probability_before = 0, seen_before = 0;
    const auto close_class = [&](double probability, double seen) {
        expected.push_back(n * (probability - probability_before));
        observed.push_back(seen - seen_before);
        probability_before = probability;
        seen_before = seen;
    };
    for (const double level : levels) {
        const std::int64_t k = count_at(level, cdf);
        const double probability = cdf(k);
        if (n * (probability - probability_before) < 9 || n * (1 - probability) < 9) continue;
        const auto seen = std::upper_bound(draws.begin(), draws.end(), k) - draws.begin();
        close_class(probability, static_cast<double>(seen));
    }
    close_class(1.0, n);
    expect_counts_fit(observed, expected);
}

// The mean is within five of its standard errors (false alarm: 6e-7).
template <class Number>
void expect_mean(const std::vector<Number>& draws, double mean, double standard_deviation) {
    double total = 0;
    for (const Number draw : draws) total += static_cast<double>(draw) - mean;
    const double n = static_cast<double>(draws.size());
    EXPECT_NEAR(total / n, 0.0, 5 * standard_deviation / std::sqrt(n));
}

}  // namespace rddl::fit
