// Policies of all kinds by one interface, and the reports of their episodes.
#include "simulators.hpp"
#include "solvers/evaluation/summary.hpp"
#include "solvers/spaces/actions.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rddlc::solvers {
namespace {

// The values are from tables of Student's distribution.
TEST(Evaluation, KnowsStudentsQuantiles) {
    const std::pair<std::int64_t, double> table[] = {{1, 12.7062},    {2, 4.3027},  {5, 2.5706},
                                                     {9, 2.2622},     {29, 2.0452}, {100, 1.9840},
                                                     {100000, 1.9600}};
    for (const auto& [degrees, quantile] : table)
        EXPECT_NEAR(student_quantile(degrees), quantile, 1.5e-3) << degrees;
}

TEST(Evaluation, EstimatesMeansAndTheirIntervals) {
    const Estimate estimate = estimate_of({1, 2, 3, 4, 5});
    EXPECT_DOUBLE_EQ(estimate.mean, 3);
    EXPECT_NEAR(estimate.deviation, std::sqrt(2.5), 1e-12);
    EXPECT_NEAR(estimate.half_width, 2.7764 * std::sqrt(2.5 / 5), 1e-3);
    EXPECT_EQ(estimate_of({0.1, 0.1, 0.1}).half_width, 0);
}

TEST(Evaluation, TellsTheSpreadOfASample) {
    const Estimate s = estimate_of({1, 2, 3, 4});
    EXPECT_EQ(s.mean, 2.5);
    EXPECT_DOUBLE_EQ(s.deviation, std::sqrt(5.0 / 3));
    EXPECT_EQ(s.minimum, 1);
    EXPECT_EQ(s.maximum, 4);
    EXPECT_EQ(estimate_of({7}).deviation, 0);
    EXPECT_EQ(estimate_of(std::vector<double>(1000, 0.1)).deviation, 0);
    EXPECT_TRUE(std::isnan(estimate_of({1, std::nan("")}).maximum));
}

// The same seeds give the same weather, whatever the policy and the number of threads.
TEST(Evaluation, PoliciesDependOnSeedAndEpisodeOnly) {
    const rddl_simulator& simulator = *rddl_simulator_reservoir_reservoir_1();
    for (const Policy& policy : {random_policy(simulator, 3), noop_policy(simulator)}) {
        EpisodeOptions options;
        options.episodes = 20;
        options.seed = 3;
        options.threads = 1;
        options.batch = 1;
        const Rollouts alone = run_episodes(simulator, policy, options, {});
        options.threads = 2;
        options.batch = 7;
        const Rollouts together = run_episodes(simulator, policy, options, {});
        for (std::size_t e = 0; e < alone.episodes.size(); ++e)
            EXPECT_EQ(alone.episodes[e].undiscounted_return,
                      together.episodes[e].undiscounted_return);
    }
}

TEST(Spaces, AreWhatTheProblemsHave) {
    const ActionSpace car = action_space(*rddl_simulator_mountain_car_mountain_car_1());
    EXPECT_EQ(car.real_count(), 1);
    EXPECT_EQ(car.reals[0].range, RealHead::Range::Bounded);
    EXPECT_EQ(car.logit_count, 0);
    const ActionSpace reservoir = action_space(*rddl_simulator_reservoir_reservoir_1());
    EXPECT_GT(reservoir.real_count(), 1);
    EXPECT_EQ(reservoir.reals[0].range, RealHead::Range::AboveLower);
    EXPECT_GT(reservoir.reals[0].scale, 1);  // as much as is legal at first
    const ActionSpace network = action_space(*rddl_simulator_network_network_1());
    EXPECT_EQ(network.max_sub_actions, 1);
    EXPECT_EQ(network.logit_count, network.column_count + 1);
    const ActionSpace delivery = action_space(*rddl_simulator_delivery_delivery_1());
    EXPECT_EQ(delivery.max_sub_actions, 2);
    EXPECT_TRUE(delivery.masked);
}

TEST(Spaces, NumbersOfRealsMeanWhatTheirRangesSay) {
    RealHead head;
    head.range = RealHead::Range::Bounded;
    head.lower = 2;
    head.upper = 6;
    EXPECT_EQ(real_value(head, 0), 4);
    EXPECT_EQ(real_value(head, -3), 2);
    EXPECT_EQ(real_value(head, 1), 6);
    head.range = RealHead::Range::AboveLower;
    head.upper = INFINITY;
    head.scale = 10;
    EXPECT_NEAR(real_value(head, 0), 2 + 10 * std::log(2.0), 1e-12);
    EXPECT_NEAR(real_value(head, -100), 2, 1e-12);
    head.range = RealHead::Range::BelowUpper;
    head.lower = -INFINITY;
    head.upper = 1;
    EXPECT_NEAR(real_value(head, 5), 1 - 10 * std::log(1 + std::exp(5.0)), 1e-9);
    head.range = RealHead::Range::Free;
    head.upper = INFINITY;
    head.centre = -1;
    EXPECT_EQ(real_value(head, 0.5), 4);
    head.rounds = true;
    EXPECT_EQ(real_value(head, 0.46), 4);
}

// Without a bound a value ends at 1e9, but not where the other bound or the default lies beyond
// that.
TEST(Spaces, BoundsMayBeFarAway) {
    RealHead head;
    head.range = RealHead::Range::Bounded;
    head.upper = 4e12;
    EXPECT_EQ(real_value(head, 0), 2e12);
    EXPECT_EQ(real_value(head, 1), 4e12);
    head.range = RealHead::Range::AboveLower;
    head.lower = 1e12;
    head.upper = INFINITY;
    EXPECT_EQ(real_value(head, 1000), 1e12 + 1000);
    EXPECT_EQ(real_value(head, 1e15), 2e12);
    head.lower = 3;
    EXPECT_EQ(real_value(head, 1e15), 1e9);
    head.centre = 3e9;
    EXPECT_EQ(real_value(head, 1e15), 6e9);
    head.range = RealHead::Range::Free;
    head.lower = -INFINITY;
    head.scale = 1e6;
    EXPECT_EQ(real_value(head, 0), 3e9);
    EXPECT_EQ(real_value(head, 1), 3.001e9);
    EXPECT_EQ(real_value(head, 1e15), 6e9);
    EXPECT_EQ(real_value(head, -1e15), -6e9);
    head.range = RealHead::Range::Bounded;
    head.rounds = true;
    head.lower = -0x1p63;
    head.upper = 0x1p63;
    EXPECT_EQ(real_value(head, 1), 9e18);
    EXPECT_EQ(real_value(head, -1), -9e18);
}

}  // namespace
}  // namespace rddlc::solvers
