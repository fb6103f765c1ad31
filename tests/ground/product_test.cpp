// `*` outside of any scope: 0 wins over what may be inf, nan or a fault.
#include "problem.hpp"

#include <gtest/gtest.h>

namespace rddlc {
namespace {

TEST(Product, WithAPositiveFiniteFactorIsPlain) {
    EXPECT_EQ(lowered("x * (1.5 + (f > 0))"), "state.x * (1.5 + real(action.f > 0.0))");
    EXPECT_EQ(lowered("(x + 1) * sqrt[2.0 + cos[n]]"),
              "(state.x + 1.0) * sqrt(2.0 + cos(real(state.n)))");
    EXPECT_EQ(lowered("n * n"), "real(state.n * state.n)") << "ints have one zero";
}

// 0 * -3.0 is 0 there, and -0 where it is a product.
TEST(Product, WithANegativeFactorKeepsTheSignOfZero) {
    EXPECT_EQ(lowered("f * 3.0"), "action.f * 3.0") << "a literal is looked at first";
    EXPECT_EQ(lowered("(x + 1) * cos[n]"),
              "select(state.x + 1.0 == 0.0, state.x + 1.0, (state.x + 1.0) * cos(real(state.n)))");
    EXPECT_EQ(lowered("x * f"), "select(action.f == 0.0, action.f, state.x * action.f)");
}

std::string lowered_for_moderate_values(const std::string& expression) {
    return value_of_x(of_moderate_values(usual_problem(expression)));
}

TEST(Product, MayBePlainForModerateValuesAlone) {
    const std::string expression = "(x + 1) * (2.0 + f * f)", square =
                                                                  "select(action.f == 0.0, "
                                                                  "action.f, action.f * action.f)";
    EXPECT_EQ(lowered(expression),
              "select(state.x + 1.0 == 0.0, state.x + 1.0, (state.x + 1.0) * "
              "(2.0 + " +
                  square + "))");
    EXPECT_EQ(lowered_for_moderate_values(expression), "(state.x + 1.0) * (2.0 + " + square + ")");
}

TEST(Product, IsZeroWhereTheFirstFactorIs) {
    // The left factor, unless the right one is a literal or a fluent.
    EXPECT_EQ(lowered("(x + 1) * (1 / x)"),
              "select(state.x + 1.0 == 0.0, state.x + 1.0, (state.x + 1.0) * (1.0 / state.x))");
    EXPECT_EQ(lowered("(1 / x) * f"),
              "select(action.f == 0.0, action.f, 1.0 / state.x * action.f)");
    EXPECT_EQ(lowered("f * exp[f]"), "select(action.f == 0.0, action.f, action.f * exp(action.f))");
}

TEST(Product, KnowsDrawsAndQuotientsBeyondAllReals) {
    EXPECT_EQ(lowered("x * Weibull(0.001, 1.0)"),
              "select(state.x == 0.0, state.x, state.x * sample weibull@0[0](0.001, 1.0))");
    EXPECT_EQ(lowered("x * (x / 0." + std::string(40, '0') + "1)"),
              "select(state.x == 0.0, state.x, state.x * (state.x / 1e-41))");
    EXPECT_EQ(lowered("x * sqrt[2.0]"), "state.x * 1.4142135623730951");
    // A float is infinite there.
    EXPECT_EQ(lowered("x * (f + 1" + std::string(39, '0') + ".0)"),
              "select(state.x == 0.0, state.x, state.x * (action.f + 1e+39))");
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

TEST(Product, KnowsInversesAndRandomVectorsBeyondAllReals) {
    const auto product_with = [](const std::string& cpf_of_v) {
        const ir::Program program =
            grounded({.pvariables = "M(obj, obj) : { non-fluent, real, default = 1.0 };\n"
                                    "m(obj) : { non-fluent, real, default = 1.0 };\n"
                                    "x : { state-fluent, real, default = 2.0 };\n"
                                    "v(obj, obj) : { interm-fluent, real };\n"
                                    "w(obj) : { interm-fluent, real };",
                      .cpfs = "v(?o, ?u) = inverse[row = ?o, col = ?u] [M(?o, ?u)];\n"
                              "w(?o) = " +
                              cpf_of_v +
                              ";\n"
                              "x' = x * (sum_{?o : obj} w(?o));"});
        return value_of_x(program);
    };
    const std::string tested =
        "select(state.x == 0.0, state.x, state.x * sum[o in obj](scratch.w[o]))";
    EXPECT_EQ(product_with("v(?o, ?o)"), tested);
    EXPECT_EQ(product_with("MultivariateNormal[?o](m(_), M(_, _))"), tested);
    EXPECT_EQ(product_with("Dirichlet[?o](m(_))"), tested);
}

TEST(Product, OfManyFactorsStaysSmall) {
    for (const std::string factor : {"exp[x]", "Poisson(x)", "(1 + exp[x])"}) {
        std::string chain = factor;
        for (int i = 0; i < 50; ++i) chain += " * " + factor;
        const ir::Program plain = grounded(usual_problem(chain));
        const ir::Program lazy = grounded(usual_problem("if (x > 3) then " + chain + " else 0"));
        EXPECT_LT(ir::print(plain).size(), 200'000u);
        EXPECT_LT(ir::print(lazy).size(), 400'000u);
    }
}

TEST(Product, OfSumsOfProductsStaysSmall) {
    std::string polynomial = "exp[x]";
    for (int i = 0; i < 50; ++i) polynomial = "(" + polynomial + " + 1) * exp[x]";
    EXPECT_LT(ir::print(grounded(usual_problem(polynomial))).size(), 50'000u);
}

TEST(Product, InAScopeIsPlain) {
    EXPECT_EQ(lowered("sum_{?o : obj} [v(?o) * (1 / x)]"),
              "sum[o in obj](state.v[o] * (1.0 / state.x))");
}

}  // namespace
}  // namespace rddlc
