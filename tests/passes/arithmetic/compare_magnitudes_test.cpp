#include "passes/arithmetic/compare_magnitudes.hpp"

#include "texts.hpp"

#include <cstddef>
#include <string>

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

// The text of the invariants that the pass leaves.
std::string of_invariants(const std::string& invariants) {
    const Problem problem{.pvariables =
                              "x : { state-fluent, real, default = 0.0 };\n"
                              "n : { state-fluent, int, default = 1 };",
                          .cpfs = "x' = x;\nn' = n;",
                          .blocks = "state-invariants { " + invariants + " };"};
    passes::Report report;
    const std::string text =
        ir::print(valid(passes::compare_magnitudes(grounded(problem), report)));
    std::string left;
    for (std::size_t at = text.find("\ninvariant "); at != text.npos;) {
        const std::size_t begin = text.find(" = ", at) + 3;
        left += text.substr(begin, text.find('\n', begin) - begin) + "; ";
        at = text.find("\ninvariant ", begin);
    }
    return left;
}

TEST(CompareMagnitudes, JoinsBoundsOfTwoInvariants) {
    EXPECT_EQ(of_invariants("x >= -2.0; x <= 2.0;"), "absolute(state.x) <= 2.0; true; ");
    EXPECT_EQ(of_invariants("x >= -2.0; n > 3; x <= 2.0;"),
              "absolute(state.x) <= 2.0; state.n > 3; true; ");
    EXPECT_EQ(of_invariants("x >= -2.0; x <= 3.0;"), "state.x >= -2.0; state.x <= 3.0; ");
}

TEST(CompareMagnitudes, LeavesInvariantsAroundOneThatMayFault) {
    const std::string text = of_invariants("x >= -2.0; gamma[x] > 1.0; x <= 2.0;");
    EXPECT_EQ(text.find("absolute"), text.npos) << text;
}

}  // namespace
}  // namespace rddlc
