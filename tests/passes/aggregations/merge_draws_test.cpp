#include "passes/aggregations/merge_draws.hpp"

#include "texts.hpp"

namespace rddlc {
namespace {

std::string merged(const std::string& cpf_of_x) {
    return of_x(cpf_of_x, passes::merge_draws).after;
}

TEST(MergeDraws, MakesOneDrawOfTwoBranches) {
    EXPECT_EQ(merged("if (x > 1.0) then Bernoulli(0.3) else Bernoulli(0.9)"),
              "real(sample bernoulli@0[0](select(state.x > 1.0, 0.3, 0.9)))");
    EXPECT_EQ(merged("if (x > 1.0) then Normal(x, 1.0) else Normal(0.0, 2.0)"),
              "sample normal@0[0](select(state.x > 1.0, state.x, 0.0), "
              "select(state.x > 1.0, 1.0, 2.0))");
}

TEST(MergeDraws, FollowsElseIfs) {
    EXPECT_EQ(
        merged("if (x > 1.0) then Bernoulli(0.3) else if (x > 2.0) then Bernoulli(0.5) "
               "else Bernoulli(0.9)"),
        "real(sample bernoulli@0[0](select(state.x > 1.0, 0.3, select(state.x > 2.0, 0.5, 0.9))))");
}

// The second branch is not drawn.
TEST(MergeDraws, MakesOneDrawUnderAConditionAlongElseIfs) {
    EXPECT_EQ(merged("if (x > 3.0) then Bernoulli(0.3) else if (x > 2.0) then x > 2.5 "
                     "else if (x > 1.0) then Bernoulli(0.5) else x > 0.0"),
              "real(select(state.x > 3.0 || !(state.x > 2.0) && state.x > 1.0, "
              "sample bernoulli@0[0](select(state.x > 3.0, 0.3, 0.5)), "
              "select(state.x > 2.0, state.x > 2.5, state.x > 0.0)))");
    const Texts x = of_x(
        "if (x > 3.0) then Bernoulli(0.3) else if ((sum_{?o : obj} exp[v(?o)]) > x)"
        " then Bernoulli(0.5) else x > 0.0",
        passes::merge_draws);
    EXPECT_EQ(x.before, x.after);
}

TEST(MergeDraws, LeavesOutDrawsThatAreDecided) {
    EXPECT_EQ(merged("if (x > 1.0) then Bernoulli(0.0) else if (x > 0.0) then Bernoulli(1.0) "
                     "else Bernoulli(x)"),
              "real(select(state.x > 1.0, false, "
              "select(state.x > 0.0, true, sample bernoulli@2[0](state.x))))");
}

TEST(MergeDraws, TellsFaultsOfTheRightDraw) {
    EXPECT_EQ(merged("if (x > 1.0) then Bernoulli(0.3) else Bernoulli(x)"),
              "real(sample bernoulli@1[0](select(state.x > 1.0, 0.3, state.x)))");
    const Texts x =
        of_x("if (x > 1.0) then Bernoulli(2.0 * x) else Bernoulli(x)", passes::merge_draws);
    EXPECT_EQ(x.before, x.after);
}

TEST(MergeDraws, TakesConstantsAlongThatDependOnTheSameObjects) {
    EXPECT_EQ(merged("if ((sum_{?o : obj} p(?o)) > 1) then true "
                     "else Bernoulli(0.1 * sum_{?o : obj} p(?o))"),
              "real(sample bernoulli@0[0](select(sum[o in obj](int(state.p[o])) > 1, 1.0, "
              "0.1 * real(sum[o in obj](int(state.p[o]))))))");
    const Texts x = of_x("if (x > 1) then true else Bernoulli(0.1 * sum_{?o : obj} p(?o))",
                         passes::merge_draws);
    EXPECT_EQ(x.before, x.after);
}

TEST(MergeDraws, NeedsTheSameNumbers) {
    for (const char* cpf : {"if (x > 1.0) then Normal(0.0, 1.0) else Uniform(0.0, 1.0)",
                            "if (x > 1.0) then Normal(0.0, 1.0) else 2.0",
                            "if (x > 1.0) then sum_{?o : obj} Normal(0.0, 1.0) else Normal(x, 1.0)",
                            "(Normal(x, 1.0) > 0.5) + Normal(x, 2.0)"}) {
        const Texts x = of_x(cpf, passes::merge_draws);
        EXPECT_EQ(x.before, x.after);
    }
}

// Products test their first factor for zero: `select(draw == 0, draw, draw * y)`.
TEST(MergeDraws, LeavesDrawsThatSomethingElseNeeds) {
    const Texts x = of_x("Normal(0.0, 1.0) * exp[x]", passes::merge_draws);
    EXPECT_EQ(x.after,
              "select(sample normal@0[0](0.0, 1.0) == 0.0, sample normal@0[0](0.0, 1.0), "
              "sample normal@0[0](0.0, 1.0) * exp(state.x))");
    EXPECT_EQ(x.before, x.after);
}

}  // namespace
}  // namespace rddlc
