#include "passes/analyses/relation.hpp"

#include <gtest/gtest.h>

namespace rddlc::passes {
namespace {

constexpr Axis x{{0}, 3}, y{{1}, 4}, z{{2}, 2};

using Tuples = std::vector<std::int64_t>;

TEST(Relation, IsOrderedByAnyAxesFirst) {
    const Relation pairs{{x, y}, {0 * 4 + 3, 1 * 4 + 0, 2 * 4 + 0}};
    const Relation turned = ordered(pairs, {y, x});
    EXPECT_EQ(turned.tuples, (Tuples{0 * 3 + 1, 0 * 3 + 2, 3 * 3 + 0}));
    EXPECT_EQ(ordered(turned, {x, y}).tuples, pairs.tuples);
}

TEST(Relation, JoinsByWhatIsShared) {
    const Relation xy{{x, y}, {0 * 4 + 3, 1 * 4 + 0, 2 * 4 + 0}};
    const Relation yz{{y, z}, {0 * 2 + 0, 0 * 2 + 1, 2 * 2 + 1}};
    const Relation joined = join(xy, yz);
    EXPECT_EQ(joined.axes, (std::vector{x, y, z}));
    EXPECT_EQ(joined.tuples, (Tuples{8, 9, 16, 17}));  // (1, 0, any), (2, 0, any)
    EXPECT_EQ(join(xy, Relation{{z}, {1}}).tuples, (Tuples{7, 9, 17}));
    EXPECT_TRUE(join(xy, Relation{{}, {}}).tuples.empty());
}

TEST(Relation, UnitesWhatHasOtherAxes) {
    const Relation some_x{{x}, {1}};
    const Relation some_z{{z}, {0}};
    EXPECT_EQ(unite(some_x, some_z)->tuples, (Tuples{0, 2, 3, 4}));
    EXPECT_EQ(unite(some_x, Relation{{x}, {0, 1}})->tuples, (Tuples{0, 1}));
}

TEST(Relation, ProjectsAwayAnAxis) {
    const Relation xy{{x, y}, {0 * 4 + 3, 1 * 4 + 0, 2 * 4 + 0, 2 * 4 + 3}};
    EXPECT_EQ(project(xy, y.variable).tuples, (Tuples{0, 1, 2}));
    EXPECT_EQ(project(xy, x.variable).tuples, (Tuples{0, 3}));
    EXPECT_EQ(project(xy, z.variable).tuples, xy.tuples);
}

}  // namespace
}  // namespace rddlc::passes
