#include "passes/arithmetic/compare_roots.hpp"

#include "texts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <random>
#include <string>

namespace rddlc {
namespace {

std::string compared_roots(const std::string& condition) {
    return of_x("if (" + condition + ") then 1.0 else x", passes::compare_roots).after;
}

TEST(CompareRoots, ComparesSquares) {
    EXPECT_EQ(compared_roots("sqrt[pow[x, 2]] < 2.0"),
              "select(power(state.x, 2.0) < 4.0, 1.0, state.x)");
    EXPECT_EQ(compared_roots("sqrt[pow[x, 2] + 1.0] >= 2.0"),
              "select(power(state.x, 2.0) + 1.0 >= 4.0, 1.0, state.x)");
    EXPECT_EQ(compared_roots("2.0 > sqrt[abs[x]]"),
              "select(absolute(state.x) < 4.0, 1.0, state.x)");
    EXPECT_EQ(compared_roots("sqrt[3.0 * abs[x]] <= 2.0"),
              "select(3.0 * absolute(state.x) <= 4.000000000000001, 1.0, state.x)");
    EXPECT_EQ(compared_roots("sqrt[x * x] < 2.0"),
              "select(select(state.x == 0.0, state.x, state.x * state.x) < 4.0, 1.0, state.x)");
    EXPECT_EQ(compared_roots("sqrt[sum_{?o : obj} [abs[v(?o)]]] > 2.0"),
              "select(sum[o in obj](absolute(state.v[o])) > 4.000000000000001, 1.0, state.x)");
    EXPECT_EQ(compared_roots("exists_{?o : obj} [sqrt[abs[x]] < W(?o)]"),
              "select(exists[o in obj](absolute(state.x) < W-squares[o]), 1.0, state.x)");
}

// The comparison with the root changes exactly where that with the square does.
TEST(CompareRoots, FindsTheNumberAtWhichComparisonsChange) {
    std::mt19937 random(7);
    for (int i = 0; i < 50; ++i) {
        const double exponent = std::uniform_real_distribution<>(-5, 5)(random);
        const std::string number = fmt::format("{:.17f}", std::exp(exponent));
        const double limit = std::stod(number);
        for (const std::string op : {"<", "<=", ">", ">="}) {
            const std::string text = compared_roots("sqrt[abs[x]] " + op + " " + number);
            const std::string begin = "select(absolute(state.x) " + op + " ";
            ASSERT_EQ(text.substr(0, begin.size()), begin);
            const double square = std::stod(text.substr(begin.size()));
            const bool is_least = op == "<" || op == ">=";
            const double below = is_least ? std::nextafter(square, 0.0) : square;
            const double above = is_least ? square : std::nextafter(square, HUGE_VAL);
            EXPECT_TRUE(is_least ? std::sqrt(below) < limit : std::sqrt(below) <= limit) << text;
            EXPECT_TRUE(is_least ? std::sqrt(above) >= limit : std::sqrt(above) > limit) << text;
        }
    }
}

TEST(CompareRoots, LeavesWhatMayBeNegativeAndUnusualLimits) {
    for (const char* condition :
         {"sqrt[x] < 2.0", "sqrt[pow[x, 2] - 1.0] < 2.0", "sqrt[x * 2.0] < 2.0",
          "sqrt[abs[x]] < -2.0", "sqrt[abs[x]] < 0.0", "sqrt[abs[x]] < 0.0000000000001",
          "sqrt[abs[x]] < 10000000000000.0", "sqrt[abs[x]] < x", "sqrt[abs[x]] == 2.0",
          "exp[abs[x]] < 2.0", "sqrt[pow[x, 3]] < 2.0"}) {
        const Texts x =
            of_x("if (" + std::string(condition) + ") then 1.0 else x", passes::compare_roots);
        EXPECT_EQ(x.before, x.after);
    }
}

}  // namespace
}  // namespace rddlc
