#include "passes/analyses/count_steps.hpp"

#include <rddl/random/distributions.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace rddlc {
namespace {

using passes::counts_by_inversion;
using Parameters = std::vector<std::vector<double>>;

rddl::Draws with_number(double number) {
    const std::array<double, rddl::Draws::first_count> numbers{number};
    return {rddl::StreamKey{}, 0, rddl::Place{0, 0}, numbers};
}

// The count that a step finds among the thresholds.
std::int64_t found(const passes::CountSteps& steps, std::size_t of, double number) {
    const std::vector<double>& thresholds = steps.thresholds[of];
    const auto count = std::ranges::count_if(thresholds, [=](double t) { return t <= number; });
    return count < std::ssize(thresholds) ? count : steps.last;
}

// The numbers at and right below all thresholds, and others; all are multiples of 2^-52.
std::vector<double> numbers_around(const std::vector<double>& thresholds) {
    std::vector<double> numbers = {0, 0.5, 1 - 0x1p-52, 1 - 0x1p-51, 1 - 0x1p-50, 1 - 0x1p-48};
    for (const double threshold : thresholds) {
        numbers.push_back(threshold - 0x1p-52);
        if (threshold < 1) numbers.push_back(threshold);
    }
    for (int k = 0; k < 256; ++k) numbers.push_back(k / 256.0);
    return numbers;
}

TEST(CountSteps, AreThoseOfPoissonDraws) {
    const Parameters rates = {{0}, {1e-300}, {0.1}, {0.14635538}, {1}, {2.5}, {9.75}};
    const auto steps = counts_by_inversion(Distribution::Poisson, rates);
    ASSERT_TRUE(steps);
    for (std::size_t of = 0; of < rates.size(); ++of)
        for (const double number : numbers_around(steps->thresholds[of])) {
            rddl::Draws draws = with_number(number);
            ASSERT_EQ(found(*steps, of, number), rddl::standard_poisson(draws, rates[of][0]))
                << rates[of][0] << " " << number;
        }
}

void expect_binomial_draws(const Parameters& parameters, bool are_failures) {
    const auto steps = counts_by_inversion(Distribution::Binomial, parameters);
    ASSERT_TRUE(steps);
    EXPECT_EQ(steps->are_failures, are_failures);
    for (std::size_t of = 0; of < parameters.size(); ++of)
        for (const double number : numbers_around(steps->thresholds[of])) {
            rddl::Draws draws = with_number(number);
            const auto trials = static_cast<std::int64_t>(parameters[of][0]);
            const std::int64_t count = found(*steps, of, number);
            ASSERT_EQ(are_failures ? trials - count : count,
                      rddl::standard_binomial(draws, trials, parameters[of][1]))
                << trials << " " << number;
        }
}

TEST(CountSteps, AreThoseOfBinomialDraws) {
    expect_binomial_draws({{0, 0.5}, {1, 0.25}, {5, 0.5}, {40, 0.2}, {1e6, 1e-7}, {3, 0}}, false);
    expect_binomial_draws({{0, 1}, {1, 0.75}, {5, 0.6}, {40, 0.8}, {1e6, 1 - 1e-7}}, true);
    EXPECT_FALSE(counts_by_inversion(Distribution::Binomial, {{1, 0.25}, {1, 0.75}}));
}

// Rounding keeps some walks from ending before their last step: their count jumps.
TEST(CountSteps, MayEndInAJump) {
    std::int64_t jumps = 0;
    for (const int k : {130, 131, 201, 235}) {
        const Parameters rate = {{k / 41.0}};
        const auto steps = counts_by_inversion(Distribution::Poisson, rate);
        if (!steps) continue;
        jumps += steps->last != std::ssize(steps->thresholds.front());
        for (const double number : numbers_around(steps->thresholds.front())) {
            rddl::Draws draws = with_number(number);
            ASSERT_EQ(found(*steps, 0, number), rddl::standard_poisson(draws, rate[0][0]))
                << rate[0][0] << " " << number;
        }
    }
    EXPECT_GT(jumps, 0);
}

}  // namespace
}  // namespace rddlc
