#include "passes/aggregations/skip_added_zeros.hpp"

#include "texts.hpp"

namespace rddlc {
namespace {

std::string by_constants(const std::string& cpf_of_x) {
    Problem problem = with_tables(cpf_of_x);
    problem.pvariables += "\nOUTER(obj) : { non-fluent, bool, default = false };";
    problem.non_fluents += "\nOUTER(b2) = true;";
    return of_x(of_moderate_values(problem), passes::skip_added_zeros).after;
}

TEST(SkipAddedZeros, ComputesOnlyTermsThatConstantsLetCount) {
    EXPECT_EQ(
        by_constants("max_{?o : obj} [(sum_{?u : obj} v(?u)) + OUTER(?o) * cos[v(?o)] * 0.5]"),
        "max[o in obj](sum[u in obj](state.v[u]) + "
        "select(OUTER[o], cos(state.v[o]) * 0.5, 0.0))");
    EXPECT_EQ(by_constants("max_{?o : obj} [OUTER(?o) * Normal(v(?o), 1.0) + 1.0]"),
              "max[o in obj](select(OUTER[o], sample normal@0[o](state.v[o], 1.0), 0.0) + 1.0)");
}

// v may be -0.0, and -0.0 + -0.0 is another zero than -0.0 + 0.0.
TEST(SkipAddedZeros, LeavesAdditionsToWhatMayBeNegativeZero) {
    EXPECT_EQ(by_constants("max_{?o : obj} [v(?o) + OUTER(?o) * cos[v(?o)]]"),
              "max[o in obj](state.v[o] + real(OUTER[o]) * cos(state.v[o]))");
}

TEST(SkipAddedZeros, LeavesCheapTermsAndBoolsOfTheState) {
    EXPECT_EQ(by_constants("max_{?o : obj} [1.0 + OUTER(?o) * v(?o)]"),
              "max[o in obj](1.0 + real(OUTER[o]) * state.v[o])");
    EXPECT_EQ(by_constants("max_{?o : obj} [1.0 + p(?o) * cos[v(?o)]]"),
              "max[o in obj](1.0 + real(state.p[o]) * cos(state.v[o]))");
}

TEST(SkipAddedZeros, ChoosesTermsThatALoopComputesOnce) {
    EXPECT_EQ(by_constants("max_{?o : obj} [1.0 + (E(?o) == 2) * (x * 2.0)]"),
              "max[o in obj](1.0 + select(E[o] == 2, state.x * 2.0, 0.0))");
    EXPECT_EQ(by_constants("max_{?o : obj} [1.0 + (E(?o) == 2) * (v(?o) * 2.0)]"),
              "max[o in obj](1.0 + real(E[o] == 2) * (state.v[o] * 2.0))");
}

TEST(SkipAddedZeros, LooksIntoSumsWhoseZerosAreAlike) {
    EXPECT_EQ(by_constants("max_{?o : obj} [1.0 + (v(?o) + (E(?o) == 2) * (x * 2.0))]"),
              "max[o in obj](1.0 + (state.v[o] + select(E[o] == 2, state.x * 2.0, 0.0)))");
    EXPECT_EQ(by_constants("max_{?o : obj} [v(?o) + (E(?o) == 2) * (x * 2.0)]"),
              "max[o in obj](state.v[o] + real(E[o] == 2) * (state.x * 2.0))");
}

TEST(SkipAddedZeros, LeavesTermsThatMayBeInfinite) {
    EXPECT_EQ(by_constants("max_{?o : obj} [1.0 + OUTER(?o) * exp[v(?o)]]"),
              "max[o in obj](1.0 + real(OUTER[o]) * exp(state.v[o]))");
}

}  // namespace
}  // namespace rddlc
