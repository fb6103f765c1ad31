// Relaxed derivatives and values, by their formulas.
#include "autodiff/evaluation.hpp"
#include "problem.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rddlc::autodiff {
namespace {

// The next x of a problem, and its derivative by the action f or, with `by_bool`, by a(b1).
struct Result {
    double value, derivative;
};

Result run(const std::string& cpf_of_x, Mode mode, double f, double a = 0, bool by_bool = false) {
    const ir::Program program = grounded(usual_problem(cpf_of_x));
    const StraightLine straight = unroll(program);
    Evaluation evaluation(straight, {.mode = mode, .sharpness = 4, .temperature = 0.5});
    for (std::size_t i = 0; i < straight.state_count; ++i) evaluation.state(i).fill(2.0);
    for (std::size_t i = 0; i < straight.action_count; ++i) evaluation.action(i).fill(a);
    evaluation.action(straight.action_count - 1).fill(f);
    evaluation.forward(std::vector<rddl::StreamKey>(lanes, {5, 6}), 3);
    Lane one;
    one.fill(1.0);
    evaluation.clear_adjoints();
    evaluation.add_next_adjoint(0, one);
    evaluation.backward();
    const std::size_t by = by_bool ? 0 : straight.action_count - 1;
    return {evaluation.next(0)[0], evaluation.action_adjoint(by)[0]};
}

double slope(double z) {  // of the sigmoid
    const double s = 1 / (1 + std::exp(-z));
    return s * (1 - s);
}

TEST(Relaxations, AreOffUnlessAskedFor) {
    for (const char* const cpf : {"if (f > 1) then 5 else 3", "round[f]", "Bernoulli(f)",
                                  "0.5 * Poisson(f)", "sgn[f]", "f == 2"})
        EXPECT_EQ(run(cpf, Mode::Exact, 0.75).derivative, 0.0) << cpf;
}

TEST(Relaxations, ForwardValuesStayExact) {
    for (const char* const cpf : {"if (f > 1) then 5 else 3", "round[f]", "Bernoulli(f)",
                                  "0.5 * Poisson(f)", "sgn[f]", "f == 2", "f * Binomial(9, f)"})
        EXPECT_EQ(run(cpf, Mode::StraightThrough, 0.75).value, run(cpf, Mode::Exact, 0.75).value)
            << cpf;
}

TEST(Relaxations, ComparisonsAreSigmoids) {
    const Result straight = run("if (f > 1) then 5 else 3", Mode::StraightThrough, 0.75);
    EXPECT_EQ(straight.value, 3.0);
    EXPECT_NEAR(straight.derivative, 2 * 4 * slope(-1), 1e-12);
    const Result soft = run("if (f > 1) then 5 else 3", Mode::Soft, 0.75);
    EXPECT_NEAR(soft.value, 3 + 2 / (1 + std::exp(1)), 1e-12);
    EXPECT_NEAR(soft.derivative, 2 * 4 * slope(-1), 1e-12);
}

// All bool actions are one half.
TEST(Relaxations, LogicIsThatOfProducts) {
    const auto soft = [](const std::string& condition) {
        return run("if (" + condition + ") then 8 else 0", Mode::Soft, 0, 0.5, true);
    };
    EXPECT_NEAR(soft("exists_{?o : obj} a(?o)").value, 7, 1e-12);
    EXPECT_NEAR(soft("exists_{?o : obj} a(?o)").derivative, 2, 1e-12);
    EXPECT_NEAR(soft("forall_{?o : obj} a(?o)").value, 1, 1e-12);
    EXPECT_NEAR(soft("forall_{?o : obj} a(?o)").derivative, 2, 1e-12);
    EXPECT_NEAR(soft("forall_{?o : obj} [a(?o) ^ ~a(?o)]").value, 0.125, 1e-12);
    EXPECT_NEAR(soft("exists_{?o : obj} [a(?o) | a(?o)]").value, 7, 1e-12);
    EXPECT_NEAR(soft("forall_{?o : obj} [a(?o) => (forall_{?u : obj} a(?u))]").value,
                8 * std::pow(1 - 0.5 * 0.875, 3), 1e-12);
    EXPECT_NEAR(soft("forall_{?o : obj} [a(?o) <=> (forall_{?u : obj} a(?u))]").value, 1, 1e-12);
}

TEST(Relaxations, SoftValuesHaveTheDerivativeOfDifferences) {
    for (const char* const cpf :
         {"if (f > x ^ ~(f < 0.2)) then f * f else sin[f]", "sgn[f] + (f == 1)", "f ~= 0.6",
          "3 * Bernoulli(f) + f", "max[f, x * (f >= 0.4)]",
          "sum_{?o : obj} [v(?o) * (f > R(?o))]"}) {
        const double width = 1e-6;
        const double differences =
            (run(cpf, Mode::Soft, 0.75 + width).value - run(cpf, Mode::Soft, 0.75 - width).value) /
            (2 * width);
        EXPECT_NEAR(run(cpf, Mode::Soft, 0.75).derivative, differences,
                    1e-6 * (1 + std::abs(differences)))
            << cpf;
    }
}

// States at the bounds of several invariants are within all of them. A relaxed bool is true above
// one half.
TEST(Relaxations, EndOfAnEpisodeIsExact) {
    Problem problem = usual_problem("f");
    problem.blocks =
        "state-invariants { x >= 1; x <= 1; forall_{?o : obj} [v(?o) <= 1]; };\n"
        "termination { exists_{?o : obj} [p(?o) ^ x > 0]; };";
    const ir::Program program = grounded(problem);
    const StraightLine straight = unroll(program);
    EXPECT_FALSE(can_be_relaxed(straight));
    const auto is_over = [&](Mode mode, double f, double v, double p) {
        Evaluation evaluation(straight, {.mode = mode});
        for (std::size_t i = 0; i < straight.state_count; ++i) evaluation.state(i).fill(0.0);
        for (std::size_t i = 2; i < 5; ++i) evaluation.state(i).fill(v);
        for (std::size_t i = 5; i < 8; ++i) evaluation.state(i).fill(p);
        for (std::size_t i = 0; i < straight.action_count; ++i) evaluation.action(i).fill(0.0);
        evaluation.action(straight.action_count - 1).fill(f);
        evaluation.forward(std::vector<rddl::StreamKey>(lanes, {5, 6}), 3);
        return evaluation.is_over(0);
    };
    for (const Mode mode : {Mode::Exact, Mode::StraightThrough, Mode::Soft}) {
        EXPECT_FALSE(is_over(mode, 1, 1, 0));
        EXPECT_TRUE(is_over(mode, 1 - 1e-9, 1, 0));
        EXPECT_TRUE(is_over(mode, 1, 1 + 1e-9, 0));
        EXPECT_TRUE(is_over(mode, 1, 1, 1));
    }
    EXPECT_FALSE(is_over(Mode::Soft, 1, 1, 0.5));
    EXPECT_TRUE(is_over(Mode::Soft, 1, 1, 0.6));
}

TEST(Relaxations, DrawsOfIntsHaveTheDerivativeOfTheirMean) {
    EXPECT_EQ(run("Poisson(f)", Mode::StraightThrough, 0.75).derivative, 1.0);
    EXPECT_EQ(run("Binomial(9, f)", Mode::StraightThrough, 0.75).derivative, 9.0);
    EXPECT_EQ(run("Bernoulli(f)", Mode::StraightThrough, 0.75).derivative, 1.0);
    EXPECT_NEAR(run("Geometric(f)", Mode::StraightThrough, 0.75).derivative, -1 / 0.5625, 1e-12);
}

}  // namespace
}  // namespace rddlc::autodiff
