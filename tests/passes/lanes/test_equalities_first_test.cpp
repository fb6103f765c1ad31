#include "passes/lanes/test_equalities_first.hpp"

#include "texts.hpp"

namespace rddlc {
namespace {

Texts tested(const std::string& condition) {
    return of_x("if (" + condition + ") then 1.0 else x", passes::test_equalities_first);
}

TEST(TestEqualitiesFirst, GuardsWhatElseHasToHold) {
    EXPECT_EQ(tested("x == 0.5 ^ exp[x] > 1.0 ^ sin[x] < 0.5").after,
              "select(select mostly first(state.x != 0.5, false, exp(state.x) > 1.0 && "
              "sin(state.x) < 0.5), 1.0, "
              "state.x)");
    EXPECT_EQ(
        tested("exp[x] > 1.0 ^ x == 0.5").after,
        "select(select mostly first(state.x != 0.5, false, exp(state.x) > 1.0), 1.0, state.x)");
}

TEST(TestEqualitiesFirst, TestsTheSecondOfTwoNext) {
    EXPECT_EQ(tested("(exp[x] > 1.0 ^ x == 0.5) ^ x == 0.25").after,
              "select(select mostly first(state.x != 0.5, false, select mostly first(state.x != "
              "0.25, false, exp(state.x) > 1.0)), 1.0, state.x)");
}

TEST(TestEqualitiesFirst, LeavesWhatIsCheapOrLikely) {
    for (const char* condition : {"x == 0.5 ^ x < 3", "x ~= 0.5 ^ exp[x] > 1.0",
                                  "x < 0.5 ^ exp[x] > 1.0", "x == 0.5 | exp[x] > 1.0"}) {
        const Texts x = tested(condition);
        EXPECT_EQ(x.before, x.after);
    }
}

TEST(TestEqualitiesFirst, KeepsDraws) {
    const Texts x = tested("x == 0.5 ^ Normal(0, 1) + exp[x] > 1.0");
    EXPECT_EQ(x.after.find("mostly first"), std::string::npos) << x.after;
}

}  // namespace
}  // namespace rddlc
