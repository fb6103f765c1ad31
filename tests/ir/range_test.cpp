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

TEST(Range, TellsWhetherAnOperationKeepsFinite) {
    const Range any{-1e300, 1e300}, tiny{1e-320, 1};
    EXPECT_TRUE(keeps_finite(Operator::Multiply, Ranges{std::nullopt, any}));
    EXPECT_TRUE(keeps_finite(Operator::Divide, Ranges{std::nullopt, Range{1e-30, 2}}));
    EXPECT_TRUE(keeps_finite(Operator::Divide, Ranges{any, Range{-2, -0.5}}));
    EXPECT_FALSE(keeps_finite(Operator::Divide, Ranges{any, tiny})) << "1 / 1e-320 is inf";
    EXPECT_FALSE(keeps_finite(Operator::Divide, Ranges{any, std::nullopt}));
    EXPECT_TRUE(keeps_finite(Operator::Power, Ranges{std::nullopt, Range{2, 2}}));
    EXPECT_TRUE(keeps_finite(Operator::Power, Ranges{Range{0, infinity}, Range{0, 16}}));
    EXPECT_FALSE(keeps_finite(Operator::Power, Ranges{any, Range{0.5, 0.5}})) << "of what is < 0";
    EXPECT_FALSE(keeps_finite(Operator::Power, Ranges{Range{2, 10}, Range{400, 400}}));
    EXPECT_FALSE(keeps_finite(Operator::Power, Ranges{Range{2, 10}, Range{-1, -1}}));
    EXPECT_TRUE(keeps_finite(Operator::Sqrt, Ranges{Range{0, infinity}}));
    EXPECT_FALSE(keeps_finite(Operator::Sqrt, Ranges{any}));
    EXPECT_FALSE(keeps_finite(Operator::Exp, Ranges{Range{0, 1}}));
}

TEST(Range, TellsWhetherTailsReachBeyondAllReals) {
    EXPECT_TRUE(draws_finite(Distribution::Normal, Ranges{std::nullopt, std::nullopt}));
    EXPECT_TRUE(draws_finite(Distribution::Weibull, Ranges{Range{0.5, 2}, std::nullopt}));
    EXPECT_FALSE(draws_finite(Distribution::Weibull, Ranges{Range{0.001, 2}, std::nullopt}));
    EXPECT_FALSE(draws_finite(Distribution::Pareto, Ranges{std::nullopt, Range{1, 1}}));
    EXPECT_FALSE(draws_finite(Distribution::Student, Ranges{Range{0.01, 2}}));
    EXPECT_FALSE(draws_finite(Distribution::Gompertz, Ranges{Range{1, 1}, Range{5e-324, 1}}));
    EXPECT_TRUE(draws_finite(Distribution::Gompertz, Ranges{Range{1, 1}, Range{0.1, 1}}));
}

TEST(Range, TellsWhetherADrawIsAlwaysPossible) {
    EXPECT_TRUE(always_in_domain(Distribution::Bernoulli, Ranges{Range{0, 1}}));
    EXPECT_TRUE(always_in_domain(Distribution::Bernoulli, Ranges{Range{-1e-9, 1 + 1e-9}}));
    EXPECT_FALSE(always_in_domain(Distribution::Bernoulli, Ranges{Range{0, 1.0001}}));
    EXPECT_FALSE(always_in_domain(Distribution::Bernoulli, Ranges{Range{-2e-9, 1}}));
    EXPECT_FALSE(always_in_domain(Distribution::Bernoulli, Ranges{std::nullopt}));
    EXPECT_TRUE(always_in_domain(Distribution::Normal, Ranges{Range{-5, 5}, Range{0, 1}}));
    EXPECT_FALSE(always_in_domain(Distribution::Normal, Ranges{Range{-5, 5}, Range{-1, 1}}));
    EXPECT_TRUE(always_in_domain(Distribution::Uniform, Ranges{Range{0, 1}, Range{1, 2}}));
    EXPECT_FALSE(always_in_domain(Distribution::Uniform, Ranges{Range{0, 3}, Range{1, 2}}));
    EXPECT_FALSE(always_in_domain(Distribution::Exponential, Ranges{Range{0, 1}}));
    EXPECT_FALSE(always_in_domain(Distribution::Geometric, Ranges{Range{0, 1}}));
    EXPECT_TRUE(always_in_domain(Distribution::Geometric, Ranges{Range{0.1, 1 + 1e-9}}));
}

}  // namespace
}  // namespace rddlc::ir
