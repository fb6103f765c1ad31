#include "passes/arithmetic/compare_magnitudes.hpp"

#include "texts.hpp"

namespace rddlc {
namespace {

std::string compared_magnitudes(const std::string& condition) {
    return of_x("if (" + condition + ") then 1.0 else x", passes::compare_magnitudes).after;
}

TEST(CompareMagnitudes, JoinsOppositeBounds) {
    EXPECT_EQ(compared_magnitudes("x < -2.4 | x > 2.4"),
              "select(absolute(state.x) > 2.4, 1.0, state.x)");
    EXPECT_EQ(compared_magnitudes("x >= 2.4 | x <= -2.4"),
              "select(absolute(state.x) >= 2.4, 1.0, state.x)");
    EXPECT_EQ(compared_magnitudes("x > -2.4 ^ x < 2.4"),
              "select(absolute(state.x) < 2.4, 1.0, state.x)");
    EXPECT_EQ(compared_magnitudes("-2.4 <= x ^ 2.4 >= x"),
              "select(absolute(state.x) <= 2.4, 1.0, state.x)");
}

TEST(CompareMagnitudes, FindsTheOtherBoundFurtherLeft) {
    EXPECT_EQ(compared_magnitudes("x < -2.4 | exp[x] > 1.0 | sin[x] < 0.5 | x > 2.4"),
              "select(absolute(state.x) > 2.4 || exp(state.x) > 1.0 || sin(state.x) < 0.5, 1.0, "
              "state.x)");
}

TEST(CompareMagnitudes, LeavesOtherPairs) {
    for (const char* condition :
         {"x < -2.4 | x > 2.5", "x < -2.4 | x >= 2.4", "x < -2.4 ^ x > 2.4", "x > -2.4 | x < 2.4",
          "x < 2.4 | x > -2.4", "x < -2.4 | exp[x] > 2.4", "x < -2.4 | x < 2.4"}) {
        const Texts x =
            of_x("if (" + std::string(condition) + ") then 1.0 else x", passes::compare_magnitudes);
        EXPECT_EQ(x.before, x.after);
    }
}

}  // namespace
}  // namespace rddlc
