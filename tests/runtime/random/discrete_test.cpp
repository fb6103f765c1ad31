#include "fit.hpp"

#include <rddl/random/distributions/continuous.hpp>
#include <rddl/random/distributions/discrete.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace rddl {
namespace {

using fit::draws_of;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// Draws of each index against their probabilities; an index of probability 0 must not occur.
void expect_indices_fit(const std::vector<std::int64_t>& draws,
                        const std::vector<double>& probabilities) {
    std::vector<double> counts(probabilities.size(), 0.0);
    for (const std::int64_t draw : draws) counts.at(static_cast<std::size_t>(draw)) += 1;
    std::vector<double> observed, expected;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (probabilities[i] == 0) {
            EXPECT_EQ(counts[i], 0) << i;
            continue;
        }
        observed.push_back(counts[i]);
        expected.push_back(probabilities[i] * static_cast<double>(draws.size()));
    }
    fit::expect_counts_fit(observed, expected);
}

TEST(Bernoulli, IsTrueAsOftenAsItShouldBe) {
    for (const double p : {0.0, 1e-3, 0.25, 0.5, 0.999, 1.0}) {
        SCOPED_TRACE(p);
        std::vector<std::int64_t> draws;
        for (const bool draw : draws_of(
                 [&](auto&context, Place place) { return sample::bernoulli(context, place, p); }))
            draws.push_back(draw);
        expect_indices_fit(draws, {1 - p, p});
    }
}

TEST(Discrete, FollowsItsProbabilities) {
    const std::array<double, 5> weights{0.1, 0.0, 0.25, 0.6, 0.05};
    expect_indices_fit(draws_of([&](auto& context, Place place) {
                           return sample::discrete(context, place, weights);
                       }),
                       {0.1, 0.0, 0.25, 0.6, 0.05});
}

constexpr std::array<double, 3> few_thresholds = {0.1, 0.1, 0.35};
constexpr std::array<std::array<double, 11>, 2> many_thresholds = {{
    {0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0},
    {0.05, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5},
}};

// Thresholds that a guide table of 8 parts separates, and others.
constexpr std::array<double, 10> even_thresholds = {
    0.0, 0.1, 0.2, 0.30000000000000004, 0.4, 0.5, 0.6, 0.75, 0.9, 1.0};
constexpr std::array<float, 9> float_thresholds = {0.1f, 0.2f, 0.3f, 0.4f, 0.5f,
                                                   0.6f, 0.7f, 0.8f, 0.9f};
constexpr std::array<double, 9> narrow_thresholds = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.801};
static_assert(sample::detail::GuideTable<even_thresholds>::parts == 8);
static_assert(sample::detail::GuideTable<narrow_thresholds>::parts == 0);

template <const auto& thresholds>
void expect_guide_to_count(double u) {
    using R = typename std::remove_cvref_t<decltype(thresholds)>::value_type;
    using Guide = sample::detail::GuideTable<thresholds>;
    const auto number = static_cast<R>(u);
    const auto reached =
        std::ranges::count_if(thresholds, [&](R threshold) { return threshold <= number; });
    EXPECT_EQ(Guide::template count<std::int64_t>(number), reached) << u;
    using Lane = Pack<16, R>;
    EXPECT_EQ(Guide::template count<typename Lane::Int>(typename Lane::Real{number})[5], reached);
}

TEST(GuideTable, CountsThresholds) {
    for (int i = 0; i < 1000; ++i) {
        expect_guide_to_count<even_thresholds>(i / 1000.0);
        expect_guide_to_count<float_thresholds>(i / 1000.0);
    }
    for (const double threshold : even_thresholds) {
        if (threshold == 1) continue;
        expect_guide_to_count<even_thresholds>(threshold);
        expect_guide_to_count<even_thresholds>(threshold + 0x1p-52);
        if (threshold > 0) expect_guide_to_count<even_thresholds>(threshold - 0x1p-52);
    }
    expect_guide_to_count<even_thresholds>(1 - 0x1p-52);
}

TEST(Interval, IsTheNumberOfThresholdsThatTheUniformNumberReaches) {
    Context<Scalar> context{stream_key(5, 0, 0), 1, {}};
    for (int i = 0; i < 1000; ++i) {
        const double u = uniform_at(context, {0, i});
        const auto reached = [&](const auto& row) {
            return std::ranges::count_if(row, [&](double threshold) { return threshold <= u; });
        };
        EXPECT_EQ(sample::interval<few_thresholds>(context, {0, i}), reached(few_thresholds));
        EXPECT_EQ(sample::interval<even_thresholds>(context, {0, i}), reached(even_thresholds));
        for (std::int64_t row = 0; row < 2; ++row)
            EXPECT_EQ(sample::interval<many_thresholds>(context, {0, i}, row),
                      reached(many_thresholds[static_cast<std::size_t>(row)]));
    }
}

constexpr std::array<std::array<std::array<double, 6>, 2>, 2> mostly_decided = {{
    {{{0.0, 0.0, 0.2, 0.9, 1.0, 1.0}, {0.0, 0.0, 0.0, 0.0, 0.0, 0.3}}},
    {{{1.0, 1.0, 1.0, 1.0, 1.0, 1.0}, {0.0, 0.5, 0.5, 1.0, 1.0, 1.5}}},
}};

TEST(Interval, LooksUpThoseThresholdsThatNumbersDecide) {
    static_assert(sample::detail::Intervals<mostly_decided>::most_open == 2);
    static_assert(sample::detail::Intervals<mostly_decided>::has_few_open);
    static_assert(!sample::detail::Intervals<many_thresholds>::has_few_open);
    Context<Scalar> context{stream_key(5, 0, 0), 1, {}};
    for (int i = 0; i < 400; ++i) {
        const double u = uniform_at(context, {0, i});
        const std::int64_t a = i % 2, b = i / 2 % 2;
        const auto& row = mostly_decided[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
        EXPECT_EQ(sample::interval<mostly_decided>(context, {0, i}, a, b),
                  std::ranges::count_if(row, [&](double threshold) { return threshold <= u; }));
    }
}

constexpr std::array<std::array<float, 4>, 2> mostly_decided_floats = {
    {{0.0f, 0.0f, 0.2f, 1.0f}, {0.7f, 1.0f, 1.0f, 1.0f}}};

TEST(Interval, LooksUpFloatsInPacks) {
    static_assert(sample::detail::Intervals<mostly_decided_floats>::has_few_open);
    using L = Pack<16, float>;
    using Word = Lanes<std::uint64_t, L::width>;
    auto context = Context<L>::of(Word{std::uint64_t{5}}, Word{std::uint64_t{7}},
                                  Word{std::uint64_t{1}}, true);
    L::Int row{0};
    for (int lane = 0; lane < L::width; ++lane) row.set(lane, lane % 2);
    for (int i = 0; i < 100; ++i) {
        const auto u = uniform_at(context, {0, i});
        const auto chosen = sample::interval<mostly_decided_floats>(context, {0, i}, row);
        for (int lane = 0; lane < L::width; ++lane)
            EXPECT_EQ(chosen[lane],
                      std::ranges::count_if(mostly_decided_floats[lane % 2],
                                            [&](float threshold) { return threshold <= u[lane]; }));
    }
}

// The draws of places that stand alone, or among those of other sites, have the same numbers.
TEST(LonePlace, ChangesNoNumber) {
    constexpr int n = 16;
    Context<Scalar> context{stream_key(5, 0, 0), 3, {}}, median{median_key, 3, {}};
    Context<ScalarOf<float>> floats{stream_key(5, 0, 0), 3, {}};
    typename Pack<n>::Word low, high;
    for (int lane = 0; lane < n; ++lane) {
        const StreamKey key =
            lane == 7 ? median_key : stream_key(5, static_cast<std::uint64_t>(lane), 0);
        low.set(lane, key.low);
        high.set(lane, key.high);
    }
    auto packs = Context<Pack<n>>::of(low, high, typename Pack<n>::Word{std::uint64_t{3}}, true);
    for (int i = 0; i < 5; ++i) {
        EXPECT_EQ(uniform_at(context, LonePlace{2, i}), uniform_at(context, Place{2, i}));
        EXPECT_EQ(uniform_at(median, LonePlace{2, i}), median_number);
        for (std::uint32_t site = 0; site < 20; ++site) {
            EXPECT_EQ(uniform_at(context, PlaceAmongSites{site, i}),
                      uniform_at(context, Place{site, i}));
            EXPECT_EQ(uniform_at(floats, PlaceAmongSites{site, i}),
                      uniform_at(floats, Place{site, i}));
        }
        EXPECT_EQ(uniform_at(median, PlaceAmongSites{2, i}), median_number);
        const auto alone = uniform_at(packs, LonePlace{2, i}), all = uniform_at(packs, Place{2, i});
        for (int lane = 0; lane < n; ++lane) EXPECT_EQ(alone[lane], all[lane]);
        EXPECT_EQ(sample::normal(context, LonePlace{1, i}, 2.0, 3.0),
                  sample::normal(context, {1, i}, 2.0, 3.0));
        EXPECT_EQ(sample::interval<few_thresholds>(context, LonePlace{0, i}),
                  sample::interval<few_thresholds>(context, {0, i}));
    }
}

TEST(Discrete, IsTheSmallestIndexWhoseSumExceedsTheUniformNumber) {
    Context<Scalar> context{stream_key(5, 0, 0), 1, {}};
    const std::array<double, 3> weights{0.2, 0.5, 0.3};
    for (int i = 0; i < 1000; ++i) {
        const double u = uniform_at(context, {0, i});
        const std::int64_t expected = u < 0.2 ? 0 : u < 0.2 + 0.5 ? 1 : 2;
        EXPECT_EQ(sample::discrete(context, {0, i}, weights), expected);
    }
}

// A sum of 0.99999 is accepted, not renormalised, and what is missing goes to index 0.
TEST(Discrete, GivesMissingMassToTheFirstIndex) {
    Context<Scalar> context{{}, 1, {}};
    std::int64_t index = 0;
    while (uniform_at(context, {0, index}) < 0.99999) ++index;
    const std::array<double, 2> weights{0.0, 0.99999};
    EXPECT_EQ(sample::discrete(context, {0, index}, weights), 0);
    EXPECT_EQ(sample::discrete(context, {0, index + 1}, weights), 1);
    EXPECT_FALSE(context.fault);
}

TEST(Discrete, ChecksTheSum) {
    const auto faults = [](double second) {
        Context<Scalar> context;
        sample::discrete(context, {3, 4}, std::array<double, 2>{0.5, second});
        return context.fault;
    };
    EXPECT_FALSE(faults(0.5));
    EXPECT_FALSE(faults(0.50001));
    EXPECT_FALSE(faults(0.49999));
    EXPECT_EQ(faults(0.500011).kind, FaultKind::ProbabilitySum);
    EXPECT_EQ(faults(0.4).kind, FaultKind::ProbabilitySum);
    EXPECT_EQ(faults(0.4).value, 0.9);
    EXPECT_EQ(faults(0.4).place, (Place{3, 4}));
    EXPECT_EQ(faults(infinity).kind, FaultKind::ProbabilitySum);
    EXPECT_EQ(faults(-0.1).kind, FaultKind::Weight);
    EXPECT_EQ(faults(nan).kind, FaultKind::Weight);
}

TEST(UnnormalisedDiscrete, FollowsItsWeights) {
    const std::array<double, 6> weights{0.0, 3.0, 1.0, 0.0, 4.0, 0.0};
    expect_indices_fit(draws_of([&](auto& context, Place place) {
                           return sample::unnormalised_discrete(context, place, weights);
                       }),
                       {0.0, 0.375, 0.125, 0.0, 0.5, 0.0});
}

// The weights divided by their total, and the total: both draws are the same, with their faults.
void expect_shares(std::array<double, 4> weights, double total, Place place) {
    Context<Scalar> context{stream_key(5, 0, 0), 1, {}}, other = context;
    const std::int64_t draw = sample::discrete_of_shares(context, place, total, weights);
    for (double& weight : weights) weight /= total;
    EXPECT_EQ(draw, sample::discrete(other, place, weights)) << total;
    EXPECT_EQ(context.fault.kind, other.fault.kind) << total;
    EXPECT_TRUE(context.fault.value == other.fault.value || std::isnan(context.fault.value));
}

TEST(DiscreteOfShares, IsDiscreteOfTheQuotients) {
    Context<Scalar> context{stream_key(5, 0, 0), 1, {}};
    for (int i = 0; i < 2000; ++i) {
        const auto number = [&](std::uint32_t site) {
            return uniform_at(context, {site, i});
        };
        const std::array<double, 4> weights{number(1), i % 3 == 0 ? 0.0 : number(2) * 1e-5,
                                            number(3), number(4) * 300};
        expect_shares(weights, weights[0] + weights[1] + weights[2] + weights[3], {0, i});
        // A limit that is the number of the draw, or its neighbour.
        const double u = number(0), scale = 1e-3 + number(5) * 50;
        for (const double first : {u, std::nextafter(u, 0.0), std::nextafter(u, 1.0)})
            expect_shares({first * scale, 0.0, (1 - first) * scale, 0.0}, scale, {0, i});
    }
}

TEST(DiscreteOfShares, FaultsLikeTheQuotients) {
    for (const double total : {0.0, -0.0, 1e-310, 3.0, 4.0, 4.00001, 4.1, -4.0, infinity, nan})
        for (int i = 0; i < 20; ++i) {
            expect_shares({1.0, 1.0, 0.0, 2.0}, total, {0, i});
            expect_shares({0.0, 0.0, 0.0, 0.0}, total, {0, i});
        }
    for (int i = 0; i < 20; ++i) {
        expect_shares({1e-310, 2e-310, 0.0, 1e-310}, 4e-310, {0, i});
        expect_shares({1e308, 0.0, 5e307, 0.0}, 1.5e308, {0, i});
    }
}

TEST(UnnormalisedDiscrete, ChecksItsWeights) {
    const auto faults = [](double first, double second) {
        Context<Scalar> context;
        const std::array<double, 2> weights{first, second};
        EXPECT_EQ(sample::unnormalised_discrete(context, {}, weights) == 0 || !context.fault, true);
        return context.fault.kind;
    };
    EXPECT_EQ(faults(1e-300, 0.0), FaultKind::None);
    EXPECT_EQ(faults(0.0, 1e300), FaultKind::None);
    EXPECT_EQ(faults(0.0, 0.0), FaultKind::WeightSum);
    EXPECT_EQ(faults(infinity, 1.0), FaultKind::WeightSum);
    EXPECT_EQ(faults(1e308, 1e308), FaultKind::WeightSum);
    EXPECT_EQ(faults(1.0, -2e-9), FaultKind::Weight);
    EXPECT_EQ(faults(nan, 1.0), FaultKind::Weight);
}

TEST(DiscreteOver, IsDiscreteOfItsWeights) {
    Context<Scalar> context{stream_key(5, 0, 0), 1, {}};
    const std::array<double, 4> weights{0.1, 0.2, 0.3, 0.4};
    const auto weight = [&](Index k) {
        return weights[static_cast<std::size_t>(k)];
    };
    for (int i = 0; i < 1000; ++i) {
        EXPECT_EQ(sample::discrete(context, {0, i}, weights),
                  sample::discrete_over(context, {0, i}, 4, weight));
        EXPECT_EQ(sample::unnormalised_discrete(context, {0, i}, weights),
                  sample::unnormalised_discrete_over(context, {0, i}, 4, weight));
    }
}

}  // namespace
}  // namespace rddl
