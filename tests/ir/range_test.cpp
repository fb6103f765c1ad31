#include "vocabulary/range.hpp"

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
    EXPECT_EQ(range_of(Operator::Ln, Ranges{Range{-1, 2}}), std::nullopt);
    EXPECT_EQ(range_of(Operator::Add, Ranges{Range{0, 1}, std::nullopt}), std::nullopt);
}

// 1e-50 is 0 as a float.
TEST(Range, OfNumbersBelowAllFloatsHoldsZero) {
    const Range tiny{1e-50, 1e-50}, small{1e-30, 1};
    EXPECT_TRUE(excludes_zero(small));
    EXPECT_TRUE(excludes_zero(Range{-1, -1e-44}));
    EXPECT_FALSE(excludes_zero(tiny));
    EXPECT_FALSE(excludes_zero(Range{-1, -1e-46}));
    EXPECT_FALSE(excludes_zero(range_of(Operator::Multiply, Ranges{small, small})));
    EXPECT_EQ(range_of(Operator::Divide, Ranges{Range{1e-20, 1e-20}, tiny}), std::nullopt);
    EXPECT_FALSE(always_in_domain(Distribution::Exponential, Ranges{tiny}));
    EXPECT_TRUE(always_in_domain(Distribution::Exponential, Ranges{small}));
}

bool is_known_finite(const std::optional<Range>& range) {
    return range && is_finite(*range);
}

TEST(Range, OfOperationsIsFiniteUnlessTheyMayOverflow) {
    const auto finite = [](Operator op, const Ranges& operands) {
        return is_known_finite(range_of(op, operands));
    };
    const Range any{-1e30, 1e30}, tiny{1e-320, 1};
    EXPECT_FALSE(finite(Operator::Multiply, {std::nullopt, any}));
    EXPECT_TRUE(finite(Operator::Multiply, {Range{-1e8, 1e8}, any}));
    EXPECT_FALSE(finite(Operator::Multiply, {any, any})) << "it is no float";
    EXPECT_TRUE(finite(Operator::Divide, {any, Range{-2, -0.5}}));
    EXPECT_FALSE(finite(Operator::Divide, {Range{1, 1}, tiny})) << "1 / 1e-320 is inf";
    EXPECT_TRUE(finite(Operator::Power, {Range{-10, 10}, Range{2, 2}}));
    EXPECT_TRUE(finite(Operator::Power, {Range{0, 10}, Range{0, 16}}));
    EXPECT_FALSE(finite(Operator::Power, {any, Range{0.5, 0.5}})) << "of what is < 0";
    EXPECT_FALSE(finite(Operator::Power, {Range{2, 10}, Range{400, 400}}));
    EXPECT_FALSE(finite(Operator::Power, {Range{2, 10}, Range{-1, -1}}));
    EXPECT_TRUE(finite(Operator::Sqrt, {Range{0, 1e30}}));
    EXPECT_FALSE(finite(Operator::Sqrt, {any}));
    EXPECT_TRUE(finite(Operator::Exp, {Range{0, 1}}));
    EXPECT_FALSE(finite(Operator::Exp, {Range{0, 1000}}));
    EXPECT_TRUE(finite(Operator::Sin, {any}));
    EXPECT_FALSE(finite(Operator::Sin, {std::nullopt})) << "of inf it is nan";
    EXPECT_FALSE(finite(Operator::Ln, {Range{0, 1}}));
    EXPECT_FALSE(finite(Operator::Acos, {Range{0, 2}}));
}

TEST(Range, OfFunctionsHoldsTheirValues) {
    EXPECT_EQ(range_of(Operator::Abs, Ranges{Range{-3, 2}}), (Range{0, 3}));
    EXPECT_EQ(range_of(Operator::Abs, Ranges{Range{-3, -2}}), (Range{2, 3}));
    EXPECT_EQ(range_of(Operator::FloorModuloReal, Ranges{Range{-9, 9}, Range{2, 3}}),
              (Range{0, 3}));
    const auto power = range_of(Operator::Power, Ranges{Range{-3, 2}, Range{2, 2}});
    EXPECT_EQ(power->lower, 0);
    EXPECT_GE(power->upper, 9);
    const auto exp = range_of(Operator::Exp, Ranges{Range{-1, 1}});
    EXPECT_LE(exp->lower, 0.3678);
    EXPECT_GE(exp->upper, 2.71828);
    EXPECT_GE(range_of_sum(Range{-1, 0.1}, 10).upper, 1.0);
    EXPECT_LE(range_of_sum(Range{-1, 0.1}, 10).lower, -10.0);
    EXPECT_EQ(range_of_sum(Range{0, infinity}, 3), (Range{0, infinity}));
    EXPECT_GE(range_of_product(Range{0, 2}, 3).upper, 8.0);
    EXPECT_LE(range_of_product(Range{-2, 2}, 3).lower, -8.0);
}

TEST(Range, OfDrawsIsFiniteUnlessTheirTailsReachBeyondAllReals) {
    const auto finite = [](Distribution distribution, const Ranges& parameters) {
        return is_known_finite(range_of(distribution, parameters));
    };
    const Range some{0, 100};
    EXPECT_TRUE(finite(Distribution::Normal, {some, some}));
    EXPECT_FALSE(finite(Distribution::Normal, {std::nullopt, some}));
    EXPECT_TRUE(finite(Distribution::Weibull, {Range{0.5, 2}, some}));
    EXPECT_FALSE(finite(Distribution::Weibull, {Range{0.001, 2}, some}));
    EXPECT_TRUE(finite(Distribution::Pareto, {Range{1, 2}, Range{1, 1}}));
    EXPECT_FALSE(finite(Distribution::Pareto, {some, Range{1, 1}}));
    EXPECT_FALSE(finite(Distribution::Student, {Range{0.01, 2}}));
    EXPECT_FALSE(finite(Distribution::Gompertz, {Range{1, 1}, Range{5e-324, 1}}));
    EXPECT_TRUE(finite(Distribution::Gompertz, {Range{1, 1}, Range{0.1, 1}}));
    EXPECT_EQ(range_of(Distribution::Beta, Ranges{some, some}), (Range{0, 1}));
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
