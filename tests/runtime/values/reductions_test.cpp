#include <rddl/values/reductions.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace rddl {
namespace {

using Int = std::int64_t;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

auto element_of(const std::vector<double>& values) {
    return [&values](Index i) {
        return values[static_cast<std::size_t>(i)];
    };
}

TEST(Sums, GoFromTheFirstObjectToTheLast) {
    const std::vector<double> values{1e16, 1.0, -1e16, 1.0};
    EXPECT_EQ(sum<double>(4, element_of(values)), ((1e16 + 1.0) - 1e16) + 1.0);
    EXPECT_EQ(sum<Int>(3, [](Index i) { return i + 1; }), 6);
    EXPECT_EQ(product<double>(4, [](Index i) { return 0.5 * static_cast<double>(i + 1); }), 1.5);
}

TEST(Aggregations, GoOverAPart) {
    const auto index = [](Index i) {
        return i;
    };
    EXPECT_EQ(sum<Int>(IndexRange(2, 5), index), 2 + 3 + 4);
    EXPECT_EQ(product<Int>(IndexRange(2, 5), index), 2 * 3 * 4);
    const std::array<Int, 4> begins{0, 2, 5, 5};
    EXPECT_EQ(sum<Int>(row(begins, 1), index), 2 + 3 + 4);
    EXPECT_EQ(sum<Int>(row(begins, 2), index), 0);
    EXPECT_EQ(product<Int>(IndexRange(2, 2), index), 1);
    EXPECT_TRUE(for_all<bool>(IndexRange(1, 3), [](Index i) { return i > 0; }));
    EXPECT_FALSE(exists<bool>(IndexRange(1, 3), [](Index i) { return i == 3; }));
}

TEST(Sums, OfIntsWrapAround) {
    const Int big = std::numeric_limits<Int>::max();
    EXPECT_EQ(sum<Int>(2, [&](Index) { return big; }), -2);
    EXPECT_EQ(product<Int>(2, [&](Index) { return big; }), 1);
}

TEST(Aggregations, OverNothingHaveTheirNeutralElement) {
    const auto never = [](Index) -> double {
        throw "not called";
    };
    const auto never_holds = [](Index) -> bool {
        throw "not called";
    };
    EXPECT_EQ(sum<double>(0, never), 0.0);
    EXPECT_EQ(product<double>(0, never), 1.0);
    EXPECT_TRUE(for_all<bool>(0, never_holds));
    EXPECT_FALSE(exists<bool>(0, never_holds));
}

TEST(Quantifiers, EvaluateEveryElement) {
    int calls = 0;
    const auto odd = [&](Index i) {
        ++calls;
        return i % 2 == 1;
    };
    EXPECT_FALSE(for_all<bool>(5, odd));
    EXPECT_EQ(calls, 5);
    EXPECT_TRUE(exists<bool>(5, odd));
    EXPECT_EQ(calls, 10);
    EXPECT_TRUE(for_all<bool>(5, [](Index i) { return i < 5; }));
    EXPECT_FALSE(exists<bool>(5, [](Index i) { return i > 5; }));
}

TEST(Extremes, AreFoundAndNanWins) {
    const std::vector<double> values{2.0, -1.0, 7.0, -1.0, 7.0};
    EXPECT_EQ(minimum_over<double>(5, element_of(values)), -1.0);
    EXPECT_EQ(maximum_over<double>(5, element_of(values)), 7.0);
    EXPECT_EQ(minimum_over<Int>(3, [](Index i) { return 5 - i; }), 3);
    for (std::size_t place = 0; place < 3; ++place) {
        std::vector<double> with_nan{infinity, -infinity, 1.0};
        with_nan[place] = nan;
        EXPECT_TRUE(std::isnan(minimum_over<double>(3, element_of(with_nan))));
        EXPECT_TRUE(std::isnan(maximum_over<double>(3, element_of(with_nan))));
    }
}

TEST(ArgExtremes, TakeTheFirstOnTies) {
    const std::vector<double> values{2.0, -1.0, 7.0, -1.0, 7.0};
    EXPECT_EQ(arg_min<Int>(5, element_of(values)), 1);
    EXPECT_EQ(arg_max<Int>(5, element_of(values)), 2);
    EXPECT_EQ(arg_max<Int>(3, [](Index) { return Int{4}; }), 0);
    EXPECT_EQ(arg_min<Int>(1, [](Index) { return infinity; }), 0);
    EXPECT_EQ(arg_max<Int>(2, [](Index i) { return to_int(i == 1); }), 1);
}

TEST(ArgExtremes, TakeTheFirstNan) {
    const std::vector<double> values{3.0, nan, -infinity, nan, infinity};
    EXPECT_EQ(arg_min<Int>(5, element_of(values)), 1);
    EXPECT_EQ(arg_max<Int>(5, element_of(values)), 1);
    const std::vector<double> first{nan, 1.0, nan};
    EXPECT_EQ(arg_min<Int>(3, element_of(first)), 0);
    EXPECT_EQ(arg_max<Int>(3, element_of(first)), 0);
}

TEST(Aggregations, WorkInConstantExpressions) {
    constexpr std::array<double, 3> values{1.0, 4.0, 2.0};
    static_assert(sum<double>(3, [&](Index i) { return values[static_cast<std::size_t>(i)]; }) ==
                  7.0);
    static_assert(arg_max<Int>(3, [&](Index i) { return values[static_cast<std::size_t>(i)]; }) ==
                  1);
    static_assert(
        sum<Int>(3, [](Index i) { return sum<Int>(2, [=](Index j) { return i * j; }); }) == 3);
}

}  // namespace
}  // namespace rddl
