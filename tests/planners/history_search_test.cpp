// plan:uct where actions are drawn, and its tree of histories.
#include "planners/uct/history_tree.hpp"
#include "planners/uct/search_rules.hpp"
#include "planning.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

namespace rddlc::planners {
namespace {

TEST(HistoryTree, FindsWhatItWasGiven) {
    HistoryTree tree(1, 2);
    const std::byte state[] = {std::byte{7}, std::byte{8}};
    const auto node = tree.node_of(99, state);
    EXPECT_EQ(tree.find(99), node);
    EXPECT_EQ(tree.find(98), 0u);
    EXPECT_EQ(tree.node_of(99, state), node);
    EXPECT_EQ(std::memcmp(tree.state(node), state, 2), 0);
    const auto first = tree.add_edge(node, state), second = tree.add_edge(node, state + 1);
    EXPECT_EQ(*tree.action(second), std::byte{8});
    EXPECT_EQ(tree.node(node).edges, 2);
    EXPECT_EQ(tree.edge(tree.node(node).first_edge).next, first);
    const auto one = tree.node_of(1, state), other = tree.node_of(2, state);
    EXPECT_EQ(tree.seen_outcome(second, 0.5), 0u);
    for (int i = 0; i < 3; ++i) tree.add_outcome(second, one);
    tree.add_outcome(second, other);
    EXPECT_EQ(tree.edge(second).outcomes, 2);
    int ones = 0;
    for (int i = 0; i < 8; ++i) ones += tree.seen_outcome(second, i / 8.0) == one;
    EXPECT_EQ(ones, 6);
}

TEST(SearchRules, ReturnsThatAreAlikeMayStillDiffer) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(range_of_returns(infinity, -infinity), 0);  // nothing was seen
    EXPECT_EQ(range_of_returns(0, 0), 0);
    EXPECT_EQ(range_of_returns(-3, 8), 11);
    EXPECT_EQ(range_of_returns(-200, -199.5), 4);
    EXPECT_EQ(range_of_returns(300, 300), 6);
}

// The optimum of the target is -0.116, that of no-op -1.
TEST(HistorySearch, DrawsActionsThatCannotBeListed) {
    const Played plan = run(target(), "plan:uct,iterations=20000");
    EXPECT_LE(plan.mean(), -0.116 + 1e-9);
    EXPECT_GT(plan.mean(), -0.2);
    const auto tried = [&](const std::string& options) {
        return run(target(), "plan:uct,iterations=1024" + options).thought(0, 0).candidates.size();
    };
    EXPECT_NEAR(static_cast<double>(tried("")), 32, 2);  // the root of the trials
    EXPECT_NEAR(static_cast<double>(tried(",width=2")), 64, 3);
    EXPECT_NEAR(static_cast<double>(tried(",width=5,widening=0")), 5, 1);
}

TEST(HistorySearch, DrawsActionsWhereThereAreTooMany) {
    const Played plan = run(network(), "plan:uct,actions=2,iterations=500", 10);
    EXPECT_GT(plan.mean(), 150);  // random actions: 138, no-op 97
    EXPECT_EQ(plan.summary.illegal_actions, 0);
}

// Each throttle costs fuel, and the flag is further away than trials get.
TEST(HistorySearch, DoesNothingWhereAllElseIsWorse) {
    const Played plan = run(car(), "plan:uct,steps=20000,horizon=20");
    EXPECT_EQ(plan.mean(), 0);
    EXPECT_EQ(plan.thought(0, 0).candidates.front().name, "noop");
    EXPECT_GT(plan.thought(0, 0).candidates.size(), 2u);
}

TEST(HistorySearch, IsTheSameOnAnyNumberOfThreads) {
    for (const rddl_simulator* simulator : {&target(), &reservoir()}) {
        const std::string planner = "plan:uct,steps=3000";
        const Played one = run(*simulator, planner, 4, 1, 0, {}, default_memory_limit, 4);
        EXPECT_EQ(one.returns(), run(*simulator, planner, 4, 2).returns());
    }
}

TEST(HistorySearch, IsNeverTooShort) {
    for (const rddl_simulator* simulator : {&reservoir(), &car(), &tiger()})
        for (const std::string budget : {"steps=1", "steps=50", "seconds=0", "iterations=1"}) {
            SCOPED_TRACE(budget);
            const Played plan = run(*simulator, "plan:uct," + budget);
            EXPECT_EQ(plan.summary.illegal_actions, 0);
            if (!budget.starts_with("steps=")) continue;
            for (const auto& [place, explanation] : plan.explanation)
                EXPECT_LE(explanation.steps, std::stoll(budget.substr(6)));
        }
}

}  // namespace
}  // namespace rddlc::planners
