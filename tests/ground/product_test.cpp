// `*` outside of any scope: 0 wins over what may be inf, nan or a fault.
#include "problem.hpp"

#include <gtest/gtest.h>

namespace rddlc {
namespace {

TEST(Product, OfFiniteFactorsIsPlain) {
    EXPECT_EQ(lowered("x * f"), "state.x * action.f");
    EXPECT_EQ(lowered("x * (x / 2.0)"), "state.x * (state.x / 2.0)");
    EXPECT_EQ(lowered("x * (x / K)"), "state.x * (state.x / 4.0)");
    EXPECT_EQ(lowered("x * pow[x, 2]"), "state.x * power(state.x, 2.0)");
    EXPECT_EQ(lowered("x * Normal(0, 1)"), "state.x * sample normal@0[0](0.0, 1.0)");
}

TEST(Product, IsZeroWhereTheFirstFactorIs) {
    // The left factor, unless the right one is a literal or a fluent.
    EXPECT_EQ(lowered("(x + 1) * (1 / x)"),
              "select(state.x + 1.0 == 0.0, state.x + 1.0, (state.x + 1.0) * (1.0 / state.x))");
    EXPECT_EQ(lowered("(1 / x) * f"),
              "select(action.f == 0.0, action.f, 1.0 / state.x * action.f)");
    EXPECT_EQ(lowered("f * exp[f]"), "select(action.f == 0.0, action.f, action.f * exp(action.f))");
}

TEST(Product, DoesNotEvaluateAFallibleFactorAtZero) {
    EXPECT_EQ(lowered("n * pow[n, n]"),
              "real(select(state.n == 0, state.n, state.n * power@0[0](state.n, state.n)))");
}

TEST(Product, TakesAFluentThatMayBecomeInfiniteSeriously) {
    const ir::Program program =
        grounded({.pvariables = "x : { state-fluent, real, default = 2.0 };\n"
                                "y : { state-fluent, real, default = 2.0 };\n"
                                "ratio : { interm-fluent, real };",
                  .cpfs = "ratio = 1 / x;\nx' = x - 1;\ny' = ratio * y;"});
    EXPECT_EQ(value_of_x(program), "state.x - 1.0");
    EXPECT_NE(step_text(program).find(
                  "next.y = select(state.y == 0.0, state.y, scratch.ratio * state.y)"),
              std::string::npos);
}

TEST(Product, InAScopeIsPlain) {
    EXPECT_EQ(lowered("sum_{?o : obj} [v(?o) * (1 / x)]"),
              "sum[o in obj](state.v[o] * (1.0 / state.x))");
}

}  // namespace
}  // namespace rddlc
