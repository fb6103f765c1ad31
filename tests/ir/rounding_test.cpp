#include "ir/rounding.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace rddlc::ir {
namespace {

double farthest(double from, const std::function<double(Rounding&)>& of) {
    double distance = 0;
    for (std::uint64_t seed = 0; seed < 16; ++seed) {
        Rounding rounding(seed);
        distance = std::max(distance, std::abs(of(rounding) - from));
    }
    return distance;
}

TEST(Rounding, ChangesLastDigitsOfFunctions) {
    const double value = std::exp(0.5);
    const double distance =
        farthest(value, [&](Rounding& r) { return r.of_function(Operator::Exp, value); });
    EXPECT_GT(distance, 1e-15);
    EXPECT_LT(distance, 1e-13);
}

TEST(Rounding, LeavesWhatIsExact) {
    for (const Operator op : {Operator::Add, Operator::Multiply, Operator::Divide, Operator::Sqrt})
        EXPECT_EQ(farthest(0.1, [&](Rounding& r) { return r.of_function(op, 0.1); }), 0);
    EXPECT_EQ(farthest(8, [](Rounding& r) { return r.of_function(Operator::Power, 8); }), 0);
    EXPECT_EQ(farthest(0.75, [](Rounding& r) { return r.sum(0.5, 0.25); }), 0);
    EXPECT_EQ(farthest(0.125, [](Rounding& r) { return r.product(0.5, 0.25); }), 0);
    Rounding rounding(0);
    EXPECT_EQ(rounding.product(HUGE_VAL, 2), HUGE_VAL);
}

// A small difference of larger numbers is as uncertain as they are.
TEST(Rounding, ChangesSumsByTheirTerms) {
    const double distance =
        farthest(0.1 + 0.7 - 0.8, [](Rounding& r) { return r.sum(r.sum(0.1, 0.7), -0.8); });
    EXPECT_GT(distance, 1e-15);
    EXPECT_LT(distance, 1e-13);
}

}  // namespace
}  // namespace rddlc::ir
