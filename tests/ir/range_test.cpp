#include "ir/range.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace rddlc::ir {
namespace {

using Ranges = std::vector<std::optional<Range>>;
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Range, OfSumsAndProductsIsThatOfTheirCorners) {
    EXPECT_EQ(range_of(Operator::Add, Ranges{Range{-1, 2}, Range{3, 4}}), (Range{2, 6}));
    EXPECT_EQ(range_of(Operator::Subtract, Ranges{Range{1, 1}, Range{0, 1}}), (Range{0, 1}));
    EXPECT_EQ(range_of(Operator::Multiply, Ranges{Range{-1, 2}, Range{3, 4}}), (Range{-4, 8}));
    EXPECT_EQ(range_of(Operator::Maximum, Ranges{Range{-1, 2}, Range{0, 1}}), (Range{0, 2}));
}

TEST(Range, IsUnknownWhereNanIsPossible) {
    EXPECT_EQ(range_of(Operator::Add, Ranges{Range{0, infinity}, Range{-infinity, 0}}),
              std::nullopt);
    EXPECT_EQ(range_of(Operator::Divide, Ranges{Range{0, 1}, Range{0, 1}}), std::nullopt);
    EXPECT_EQ(range_of(Operator::Ln, Ranges{Range{1, 2}}), std::nullopt);
    EXPECT_EQ(range_of(Operator::Add, Ranges{Range{0, 1}, std::nullopt}), std::nullopt);
}

TEST(Range, TellsWhetherADrawIsAlwaysPossible) {
    EXPECT_TRUE(always_in_domain(Distribution::Bernoulli, Ranges{Range{0, 1}}));
    EXPECT_FALSE(always_in_domain(Distribution::Bernoulli, Ranges{Range{0, 1.0001}}));
    EXPECT_FALSE(always_in_domain(Distribution::Bernoulli, Ranges{std::nullopt}));
    EXPECT_TRUE(always_in_domain(Distribution::Normal, Ranges{Range{-5, 5}, Range{0, 1}}));
    EXPECT_FALSE(always_in_domain(Distribution::Normal, Ranges{Range{-5, 5}, Range{-1, 1}}));
    EXPECT_TRUE(always_in_domain(Distribution::Uniform, Ranges{Range{0, 1}, Range{1, 2}}));
    EXPECT_FALSE(always_in_domain(Distribution::Uniform, Ranges{Range{0, 3}, Range{1, 2}}));
    EXPECT_FALSE(always_in_domain(Distribution::Exponential, Ranges{Range{0, 1}}));
    EXPECT_FALSE(always_in_domain(Distribution::Geometric, Ranges{Range{0, 1}}));
}

}  // namespace
}  // namespace rddlc::ir
