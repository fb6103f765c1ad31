// Draws at different places, steps, environments, episodes and seeds have nothing to do with each
// other: correlations of 100000 pairs stay within five standard errors (false alarm: 6e-7 each),
// and pairs fill the unit square evenly.
#include "fit.hpp"

#include <rddl/random/random.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace rddl {
namespace {

constexpr int pair_count = 100000;

struct Coordinates {
    std::uint64_t seed = 1, environment = 2, episode = 3;
    std::uint32_t step = 4, site = 5, index = 6;
};

double uniform_of(const Coordinates& c) {
    Context<Scalar> context{stream_key(c.seed, c.environment, c.episode), c.step, {}};
    return uniform_at(context, {c.site, c.index});
}

// `pair(i)` gives the i-th pair of numbers.
template <class Pair>
void expect_independent(Pair pair) {
    constexpr int cells = 16;
    std::vector<double> observed(cells * cells, 0.0);
    double covariance = 0;
    for (int i = 0; i < pair_count; ++i) {
        const auto [a, b] = pair(static_cast<std::uint32_t>(i));
        covariance += (a - 0.5) * (b - 0.5);
        const int cell = static_cast<int>(a * cells) * cells + static_cast<int>(b * cells);
        observed[static_cast<std::size_t>(cell)] += 1;
    }
    const double correlation = 12 * covariance / pair_count;
    EXPECT_LT(std::fabs(correlation), 5 / std::sqrt(pair_count));
    const double expected = static_cast<double>(pair_count) / (cells * cells);
    fit::expect_counts_fit(observed, std::vector<double>(observed.size(), expected));
}

// Neighbours in one coordinate, over many values of it.
template <class Number>
void expect_neighbours_independent(Number Coordinates::*coordinate) {
    for (const std::uint32_t distance : {1u, 2u, 1000u})
        expect_independent([&](std::uint32_t i) {
            Coordinates first, second;
            first.*coordinate = 2 * distance * i;
            second.*coordinate = 2 * distance * i + distance;
            return std::pair(uniform_of(first), uniform_of(second));
        });
}

TEST(Independence, OfSeeds) {
    expect_neighbours_independent(&Coordinates::seed);
}
TEST(Independence, OfEnvironments) {
    expect_neighbours_independent(&Coordinates::environment);
}
TEST(Independence, OfEpisodes) {
    expect_neighbours_independent(&Coordinates::episode);
}
TEST(Independence, OfSteps) {
    expect_neighbours_independent(&Coordinates::step);
}
TEST(Independence, OfSites) {
    expect_neighbours_independent(&Coordinates::site);
}
TEST(Independence, OfIndices) {
    expect_neighbours_independent(&Coordinates::index);
}

TEST(Independence, OfNumbersWithinADraw) {
    for (const int distance : {1, 2, 3})
        expect_independent([&](std::uint32_t i) {
            Draws draws({stream_key(1, 2, 3), 4, {}}, {5, i});
            const double first = draws.uniform();
            double second = 0;
            for (int k = 0; k < distance; ++k) second = draws.uniform();
            return std::pair(first, second);
        });
}

// Coordinates that are easily confused: step and index, environment and episode.
TEST(Independence, OfSwappedCoordinates) {
    expect_independent([](std::uint32_t i) {
        return std::pair(uniform_of({.step = 7, .index = i + 8}),
                         uniform_of({.step = i + 8, .index = 7}));
    });
    expect_independent([](std::uint32_t i) {
        return std::pair(uniform_of({.environment = 7, .episode = i + 8}),
                         uniform_of({.environment = i + 8, .episode = 7}));
    });
}

}  // namespace
}  // namespace rddl
