#include "planning.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rddlc::planners {
namespace {

// The policy is no-op, which stays: to stay is worth 1 + 1 + 1 + 1, to climb (2 + 2 + 2)/2, to leap
// 8/4.
TEST(Rollouts, ValueActionsByThePolicyThatPlaysOn) {
    const Played plan = run(ladder(), "plan:rollout,policy=noop,iterations=200");
    const Explanation& explanation = plan.thought(0, 0);
    ASSERT_EQ(explanation.candidates.size(), 3u);
    EXPECT_EQ(explanation.candidates[0].name, "policy");
    EXPECT_DOUBLE_EQ(explanation.candidates[0].value, 4);
    EXPECT_NEAR(explanation.candidates[1].value, 3, 0.25);
    EXPECT_NEAR(explanation.candidates[2].value, 2, 0.25);
    EXPECT_EQ(explanation.chosen, 0u);
    EXPECT_EQ(explanation.depth, 4);
}

// No-op has a reward of 1 in each of 4 steps; a step of improvement is better by what the last
// steps gain.
TEST(Rollouts, ImproveAPolicy) {
    const double noop = run(reservoir(), "plan:rollout,policy=noop,steps=1", 10).mean();
    const double better = run(reservoir(), "plan:rollout,policy=noop,steps=20000", 10).mean();
    EXPECT_GT(better, noop + 0.1 * std::abs(noop));
}

// A policy that is the best there is is left alone, since nothing is surely better.
TEST(Rollouts, KeepThePolicyInDoubt) {
    const Played plan = run(coin(), "plan:rollout,policy=noop,steps=2000,confidence=100", 3);
    for (const auto& [place, explanation] : plan.explanation) EXPECT_EQ(explanation.chosen, 0u);
}

}  // namespace
}  // namespace rddlc::planners
