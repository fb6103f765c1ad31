#include "passes/arithmetic/fast_math.hpp"
#include "passes/arithmetic/reduce_strength.hpp"
#include "texts.hpp"

namespace rddlc {
namespace {

std::string reduced(const std::string& cpf_of_x) {
    return of_x(cpf_of_x, passes::reduce_strength).after;
}
ir::Program reduce_floats(ir::Program program, passes::Report& report) {
    program.real = RealType::Float;
    return passes::reduce_strength(std::move(program), report);
}
std::string relaxed(const std::string& cpf_of_x) {
    return of_x(cpf_of_x, passes::fast_math).after;
}

TEST(ReduceStrength, MultipliesInsteadOfDividingByPowersOfTwo) {
    EXPECT_EQ(reduced("x / 4 + x / -0.5"), "state.x * 0.25 + state.x * -2.0");
    EXPECT_EQ(reduced("x / 3"), "state.x / 3.0") << "1/3 is not exact";
}

// By 2^-140.
TEST(ReduceStrength, DividesFloatsWhereOneOfTheTwoIsNotNormal) {
    const std::string quotient =
        "x / 0.00000000000000000000000000000000000000000071746481373430634";
    EXPECT_EQ(reduced(quotient), "state.x * 1.393796574908164e+42");
    EXPECT_EQ(of_x(quotient, reduce_floats).after, "state.x / 7.174648137343064e-43");
    EXPECT_EQ(of_x("x / 4", reduce_floats).after, "state.x * 0.25");
}

TEST(ReduceStrength, MultipliesInsteadOfRaising) {
    EXPECT_EQ(reduced("pow[x, 2]"), "state.x * state.x");
    EXPECT_EQ(reduced("pow[x, 3]"), "power(state.x, 3.0)") << "rounded once, not twice";
    EXPECT_EQ(reduced("sum_{?o : obj} pow[E(?o), 3]"), "real(sum[o in obj](E[o] * E[o] * E[o]))");
    EXPECT_EQ(reduced("pow[exp[x], 2]"), "power(exp(state.x), 2.0)");
}

TEST(ReduceStrength, DropsZeroTimesABool) {
    EXPECT_EQ(reduced("x + sum_{?o : obj} [0.0 * p(?o)]"), "state.x + 0.0");
    EXPECT_EQ(reduced("sum_{?o : obj} [0.0 * v(?o)]"), "sum[o in obj](0.0 * state.v[o])");
}

TEST(ReduceStrength, ChoosesWhereABoolDecidesASum) {
    EXPECT_EQ(reduced("sum_{?o : obj} [p(?o) * 1.25 + ~p(?o)]"),
              "sum[o in obj](select(state.p[o], 1.25, 1.0))");
    EXPECT_EQ(reduced("sum_{?o : obj} [~p(?o) - 2.5 * p(?o)]"),
              "sum[o in obj](select(state.p[o], -2.5, 1.0))");
    EXPECT_EQ(reduced("sum_{?o : obj} [p(?o) * 0.5 + p(?o)]"),
              "sum[o in obj](select(state.p[o], 1.5, 0.0))");
}

TEST(FastMath, MultipliesByReciprocals) {
    EXPECT_EQ(relaxed("x / 5"), "state.x * 0.2");
    EXPECT_EQ(relaxed("x * 3 / 2"), "state.x * 1.5");
    EXPECT_EQ(relaxed("2 * x * 4"), "8.0 * state.x");
    EXPECT_EQ(relaxed("x / 0"), "state.x / 0.0");
    EXPECT_EQ(relaxed("sum_{?o : obj} [x / E(?o)]"), "sum[o in obj](state.x * (1.0 / real(E[o])))");
    EXPECT_EQ(relaxed("x + sum_{?o : obj} [1 / E(?o)]"),
              "state.x + sum[o in obj](1.0 / real(E[o]))");
    EXPECT_EQ(relaxed("sum_{?o : obj} [0.5 * x / E(?o)]"),
              "sum[o in obj](state.x * (0.5 / real(E[o])))");
    EXPECT_EQ(relaxed("sum_{?o : obj} [x / v(?o)]"), "sum[o in obj](state.x / state.v[o])");
}

TEST(FastMath, BringsConstantFactorsTogether) {
    EXPECT_EQ(relaxed("2 * exp[x] * x / 4"), "0.5 * exp(state.x) * state.x");
    EXPECT_EQ(relaxed("x * (exp[x] * 2) * 4"), "state.x * (exp(state.x) * 8.0)");
    EXPECT_EQ(relaxed("(3 - 2 * x) / 4"), "0.75 - 0.5 * state.x");
    EXPECT_EQ(relaxed("x / (0.5 * (x * 4 + 3))"), "state.x / (state.x * 2.0 + 1.5)");
    EXPECT_EQ(relaxed("0 - 2 * x"), "-2.0 * state.x");
    EXPECT_EQ(relaxed("(2 * x - exp[x] * 3) * 4"), "8.0 * state.x - exp(state.x) * 12.0");
    EXPECT_EQ(relaxed("2 * (x + 1)"), "2.0 * (state.x + 1.0)") << "as many operations";
}

TEST(FastMath, BringsConstantTermsTogether) {
    EXPECT_EQ(relaxed("x + 3 - exp[x] - 1"), "state.x + 2.0 - exp(state.x)");
    EXPECT_EQ(relaxed("x + 3 - exp[x] - 3"), "state.x - exp(state.x)");
    EXPECT_EQ(relaxed("1 + (exp[x] - (x + 3))"), "exp(state.x) - (state.x + 2.0)");
    EXPECT_EQ(relaxed("(3 - x) - 3"), "0.0 - state.x");
    EXPECT_EQ(relaxed("(3 + x) - 3"), "state.x");
    EXPECT_EQ(relaxed("(x * 2 + 1) * 3 + 4"), "state.x * 6.0 + 7.0");
}

TEST(FastMath, SubtractsMultiplesForRemainders) {
    EXPECT_EQ(relaxed("fmod[x, 4]"), "state.x - 4.0 * real(floor(state.x * 0.25))");
    EXPECT_EQ(relaxed("fmod[x, 0]"), "floor_mod_real(state.x, 0.0)");
    EXPECT_EQ(relaxed("fmod[4, x]"), "floor_mod_real(4.0, state.x)");
}

TEST(FastMath, DropsZeroTimesAnything) {
    EXPECT_EQ(relaxed("x + sum_{?o : obj} [0.0 * v(?o)]"), "state.x");
    EXPECT_EQ(relaxed("x + sum_{?o : obj} [v(?o) * (0.0 * p(?o))]"), "state.x");
}

TEST(FastMath, TestsNoFactorForZero) {
    const Texts x = of_x("x * exp[x]", passes::fast_math);
    EXPECT_EQ(x.before, "select(state.x == 0.0, state.x, state.x * exp(state.x))");
    EXPECT_EQ(x.after, "state.x * exp(state.x)");
    EXPECT_EQ(relaxed("x * lngamma[x]"),
              "select(state.x == 0.0, state.x, state.x * ln_gamma@0[0](state.x))");
}

TEST(FastMath, ComparesWithZeroLast) {
    EXPECT_EQ(relaxed("max[0.0, x] + min[0.0, x]"),
              "maximum(state.x, 0.0) + minimum(state.x, 0.0)");
    EXPECT_EQ(relaxed("max[2.0, x]"), "maximum(2.0, state.x)");
}

TEST(FastMath, KnowsSmallPowers) {
    EXPECT_EQ(relaxed("pow[x, 3] + pow[x, 0.5]"), "state.x * state.x * state.x + sqrt(state.x)");
}

}  // namespace
}  // namespace rddlc
