#include "ir/lane_count.hpp"

#include "ir/cost_model.hpp"
#include "programs.hpp"

#include <gtest/gtest.h>

namespace rddlc::ir {
namespace {

struct LaneCountTest : testing::Test {
    // running' = running ~= ~seen | ..., so many times over: no part decides another one.
    NodeId connectives(int count) {
        NodeId value = w.at(w.running, w.c);
        for (int k = 0; k < count; ++k)
            value = w.apply(k % 2 == 0 ? Operator::NotEqual : Operator::Or, value,
                            w.apply(Operator::Not, w.at(k % 3 == 0 ? w.seen : w.reboot, w.c)));
        return value;
    }
    NodeId is_high() { return w.apply(Operator::Greater, w.load(w.level), w.real(4)); }
    int lanes_of(std::vector<Definition> step) {
        w.program.step = std::move(step);
        return suitable_lane_count(w.program);
    }
    Workbench w;
};

TEST_F(LaneCountTest, BoolsAloneTakeManyLanes) {
    EXPECT_EQ(lanes_of({w.fill(w.next_running, w.c, connectives(3))}), 64);
}

TEST_F(LaneCountTest, NumbersTakeFew) {
    EXPECT_EQ(lanes_of({w.assign(w.next_level, w.apply(Operator::Exp, w.load(w.level)))}), 16);
    EXPECT_EQ(lanes_of({}), 16);
}

TEST_F(LaneCountTest, AFewNumbersDoNotMatterAmongManyBools) {
    const auto with_bools = [&](int count) {
        return lanes_of({w.fill(w.next_running, w.c, connectives(count)),
                         w.fill(w.next_running, w.d, is_high())});
    };
    EXPECT_EQ(with_bools(1), 16);
    EXPECT_EQ(with_bools(60), 64);
}

TEST_F(LaneCountTest, DrawsDoNotCount) {
    const NodeId value = w.apply(Operator::And, w.at(w.running, w.c), w.bernoulli(w.real(0.5)));
    EXPECT_EQ(lanes_of({w.fill(w.next_running, w.c, value)}), 64);
    w.program.step = {w.fill(w.next_running, w.c, value)};
    EXPECT_EQ(pack_cost_of_step(w.program).draws, 3 * draw_cost);
}

TEST_F(LaneCountTest, ActionsOfManyLanesMustFitIntoTheCache) {
    const std::vector<Definition> step = {w.fill(w.next_running, w.c, connectives(60))};
    w.program.buffers[w.reboot.index].shape = {512};
    EXPECT_EQ(lanes_of(step), 64);
    w.program.buffers[w.reboot.index].shape = {513};
    EXPECT_EQ(lanes_of(step), 16);
}

// A step that reads few of very many bools takes longer in packs, which read them all.
TEST_F(LaneCountTest, ActionsThatAreReadInPartAreLeftToSingleEnvironments) {
    const std::vector<Definition> step = {w.fill(w.next_running, w.c, connectives(3))};
    w.program.buffers[w.reboot.index].shape = {300};
    EXPECT_EQ(lanes_of(step), 64);
    w.program.buffers[w.reboot.index].shape = {4000};
    EXPECT_EQ(lanes_of(step), 1);
}

// Packs would wait for the next cache, unless there is much to compute for each action.
TEST_F(LaneCountTest, ActionsOfFewLanesMustFitIntoTheCacheToo) {
    const auto with_actions = [&](std::int64_t count, int operations) {
        w.program.buffers[w.reboot.index].shape = {count};
        return lanes_of({w.fill(w.next_running, w.c, connectives(operations))});
    };
    EXPECT_EQ(with_actions(2048, 400), 16);
    EXPECT_EQ(with_actions(2049, 400), 1);
    EXPECT_EQ(with_actions(2049, 10'000), 16);
}

// Packs of few lanes skip more often what no action chooses.
TEST_F(LaneCountTest, BoolsThatActionsMustChooseDoNotCount) {
    const std::vector<Definition> bools = {w.fill(w.next_running, w.c, connectives(60)),
                                           w.fill(w.next_running, w.d, is_high())};
    EXPECT_EQ(lanes_of(bools), 64);
    std::vector<Definition> unless_unchosen = bools;
    unless_unchosen.front().unchosen = {{w.reboot}, w.running};
    EXPECT_EQ(lanes_of(unless_unchosen), 16);
    EXPECT_GT(pack_cost_of_step(w.program).unchosen, 0);
    const double cost = cost_of_step(w.program);
    w.program.step = bools;
    EXPECT_EQ(cost, cost_of_step(w.program));
}

// Both costs count the same work, but loops over several objects at once.
TEST_F(LaneCountTest, ThePartsOfAPacksCostAreTheWhole) {
    w.program.step = {w.fill(w.next_running, w.c, connectives(3)),
                      w.assign(w.next_level, w.apply(Operator::Exp, w.load(w.level)))};
    const PackCost cost = pack_cost_of_step(w.program);
    EXPECT_EQ(step_cost + cost.block + cost.reals + cost.draws, cost_of_step(w.program));
    EXPECT_EQ(cost.reals, 1 + elementary_cost + 1);
    EXPECT_EQ(cost.ints, 0);
}

TEST_F(LaneCountTest, ByteIntsSuitBoolsAndIntsButNotRealsOrBoolsAlone) {
    const NodeId is_small = w.apply(Operator::LessEqual, w.load(w.count), w.integer(8));
    const auto suits = [&](const std::vector<NodeId>& bools) {
        w.program.step.clear();
        for (const NodeId each : bools) w.program.step.push_back(w.fill(w.next_running, w.c, each));
        return suits_byte_ints(w.program);
    };
    EXPECT_TRUE(suits({is_small}));
    EXPECT_TRUE(suits({connectives(10), is_small}));
    EXPECT_FALSE(suits({connectives(10)}));
    EXPECT_FALSE(suits({is_small, is_high()}));
}

}  // namespace
}  // namespace rddlc::ir
