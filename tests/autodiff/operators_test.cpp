// Each operator and distribution: forward values are the interpreter's, derivatives are
// differences.
#include "autodiff/partials.hpp"
#include "passes/aggregations/shorten_aggregations.hpp"
#include "problem.hpp"
#include "step_check.hpp"
#include "support/failure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rddlc::autodiff {
namespace {

StepCheck check(const std::string& cpf_of_x) {
    const ir::Program program = grounded(usual_problem(cpf_of_x));
    StepCheck result = StepChecker(program).run(6);
    EXPECT_EQ(result.different_values, 0) << cpf_of_x << ": " << result.first_complaint;
    EXPECT_EQ(result.wrong_derivatives, 0) << cpf_of_x << ": " << result.first_complaint;
    EXPECT_GT(result.derivatives, 0) << cpf_of_x;
    EXPECT_LT(2 * result.not_smooth, result.derivatives) << cpf_of_x;
    return result;
}

TEST(Derivatives, OfOperators) {
    for (const char* const expression :
         {"f + x - 3 * x * f", "x / (1 + f * f)", "-f * x", "abs[f] + sgn[f] * x",
          "min[x, f] + max[2 * f, x]", "fmod[x, 1.5] + fmod[7, 1 + abs[f]]",
          "pow[2 + f * f, x / 9]", "pow[f, 3]", "exp[f / 4] + ln[1 + f * f]", "sqrt[1 + f * f]",
          "cos[f] + sin[x] * tan[f]", "acos[0.9 * sin[f]] + asin[0.9 * cos[f]] + atan[f * x]",
          "cosh[f] + sinh[f] - tanh[f]", "log[2 + f * f, 3 + sin[f]]", "hypot[f, 1 + x]",
          "lngamma[1 + f * f] + gamma[2 + sin[f]]", "round[f] + floor[x] * ceil[f]",
          "n * f + div[n, 2] * x + mod[n, 2]"})
        check(std::string("sin[") + expression + "]");
}

// Its values fault there, but derivatives are asked for before that is known.
TEST(Derivatives, OfLnGammaEndAtOnceBelowZero) {
    for (const double x : {0.0, -1.5, -1e9, -1e17, -std::numeric_limits<double>::infinity()})
        EXPECT_TRUE(std::isnan(of_operator(Operator::LnGamma, x, 0, 0).a)) << x;
}

TEST(Derivatives, OfBranchesAndAggregations) {
    for (const char* const expression :
         {"if (f > 0.3 ^ x < 9) then f * f else sin[x]", "sum_{?o : obj} [v(?o) * R(?o) * f]",
          "prod_{?o : obj} [v(?o) + f]", "avg_{?o : obj} [v(?o) * v(?o)]",
          "(max_{?o : obj} [v(?o) * R(?o)]) * f", "(min_{?o : obj} [v(?o) + R(?o) * f])",
          "v(argmax_{?o : obj} [R(?o) * f]) * f", "q(near(argmax_{?o : obj} [v(?o)])) * q(c) * f",
          "f * (exists_{?o : obj} [v(?o) > 2 | p(?o)]) + x * (forall_{?o : obj} [~a(?o)])",
          "switch (c) { case @red : f * f, case @green : sin[f], default : x * x }",
          "(sum_{?o : obj} a(?o)) * f + (sum_{?o : obj} [a(?o) => p(?o)]) * x"})
        check(std::string("sin[") + expression + "]");
}

TEST(Derivatives, OfDraws) {
    for (const char* const draw :
         {"Uniform(f, 1 + f * f + abs[f])", "Normal(f, 0.5 + x * x)", "Exponential(1 + f * f)",
          "Weibull(1 + f * f, 2 + sin[x])", "Gamma(2.5, 1 + f * f)", "Pareto(2 + f * f, 1 + x * x)",
          "Gumbel(f, 1 + x * x)", "Laplace(f, 1 + x * x)", "Cauchy(f, 1 + x * x)",
          "Gompertz(1 + f * f, 2 + sin[x])", "Kumaraswamy(1 + f * f, 2 + sin[x])",
          "Student(3) + Beta(2, 3) * f + ChiSquare(3)", "f * Poisson(2 + 0.0 * x)",
          "f * Bernoulli(0.5) + x * Binomial(3, 0.5) + Geometric(0.4) * f",
          "f * NegativeBinomial(2, 0.5)"})
        check(std::string("sin[") + draw + "]");
}

// A product with zero has the derivative of a product, not of the zero that it is.
TEST(Derivatives, OfProductsWithZero) {
    const ir::Program program = grounded(usual_problem("(f - 3.0) * x"));
    const StraightLine straight = unroll(program);
    Evaluation evaluation(straight, {});
    const NumberLayout states(program, ir::Storage::State);
    for (std::size_t i = 0; i < straight.state_count; ++i) evaluation.state(i).fill(2.0);
    for (std::size_t i = 0; i < straight.action_count; ++i) evaluation.action(i).fill(3.0);
    evaluation.forward(std::vector<rddl::StreamKey>(lanes), 0);
    Lane one;
    one.fill(1.0);
    evaluation.add_next_adjoint(0, one);
    evaluation.backward();
    EXPECT_EQ(evaluation.next(0)[0], 0.0);
    EXPECT_EQ(evaluation.action_adjoint(straight.action_count - 1)[0], 2.0);
    EXPECT_EQ(evaluation.state_adjoint(0)[0], 0.0);
}

// Faults count where a value is used, and nowhere else.
TEST(Derivatives, BranchesThatAreNotTakenDoNotFault) {
    const StepCheck result =
        check("if (x > 1000) then Normal(f, -1) + gamma[-1] else x + f * Bernoulli(0.5)");
    EXPECT_EQ(result.steps, 6);
    const ir::Program faulty = grounded(usual_problem("if (x < 1000) then Normal(f, -1) else f"));
    const StepCheck faults = StepChecker(faulty).run(3);
    EXPECT_EQ(faults.different_values, 0) << faults.first_complaint;
    EXPECT_EQ(faults.derivatives, 0);
}

TEST(Derivatives, UnrollOnlyWhatTheInstanceLeavesOpen) {
    const ir::Program program = grounded(
        usual_problem("sum_{?o : obj, ?b : pair} [if (B(?o, ?b)) then v(?o) * exp[R(?o)] else 0]"));
    EXPECT_EQ(unroll(program).instructions.size(), 3u);  // B holds once: a product and two sums
}

// The inner sum is taken out of the outer one, and made once.
TEST(Derivatives, FactorsOfAggregationsSaveInstructions) {
    const ir::Program program =
        grounded(usual_problem("f * (sum_{?o : obj, ?r : obj} [a(?o) ^ p(?r)])"));
    const ir::Program shorter = shorten_aggregations(program);
    EXPECT_LT(unroll(shorter).instructions.size(), unroll(program).instructions.size());
    const StepCheck result = StepChecker(shorter).run(6);
    EXPECT_EQ(result.different_values + result.wrong_derivatives, 0) << result.first_complaint;
    EXPECT_GT(result.derivatives, 0);
}

TEST(Derivatives, FunctionsOfMatricesAreRefused) {
    Problem problem{.pvariables = "m(obj, obj) : { state-fluent, real, default = 1.0 };",
                    .cpfs = "m'(?i, ?j) = m(?i, ?j) * (det_{?r : obj, ?c : obj} [m(?r, ?c)]);"};
    const ir::Program program = grounded(problem);
    EXPECT_THROW(unroll(program), Failure);
}

}  // namespace
}  // namespace rddlc::autodiff
