// Faults that are reported before a run, and those that are not.
#include "problem.hpp"

#include <vector>

namespace rddlc {
namespace {

// The messages about the right-hand side of x'.
std::string told(const std::string& expression, const std::string& non_fluents = {}) {
    Problem problem = usual_problem(expression);
    problem.non_fluents += non_fluents;
    const Grounded grounded = ground_text(problem.text());
    EXPECT_TRUE(grounded.program) << grounded.messages;
    std::string text;
    for (std::size_t at = 0; (at = grounded.messages.find("[W0601]", at)) != std::string::npos;
         ++at) {
        const std::size_t line = grounded.messages.rfind("warning: ", at) + 9;
        text += (text.empty() ? "" : "\n") + grounded.messages.substr(line, at - line - 1);
    }
    return text;
}

TEST(CertainFaults, AreToldOfAllDistributions) {
    const std::string always = ": this faults whenever it is evaluated";
    EXPECT_EQ(told("Bernoulli(1.5)"),
              "Bernoulli's probability must be in [0, 1], found 1.5" + always);
    EXPECT_EQ(told("Normal(0.0, -1.0)"),
              "Normal's variance must not be negative, found -1" + always);
    EXPECT_EQ(told("Uniform(2.0, 1.0)"),
              "Uniform's upper bound minus lower bound must be finite and not negative, found -1" +
                  always);
    EXPECT_EQ(told("Poisson(-1.0)"), "Poisson's rate must be in [0, 9.2e18], found -1" + always);
    EXPECT_EQ(told("Binomial(-K, 0.5)"),
              "Binomial's number of trials must not be negative, found -4" + always);
    for (const char* faulty :
         {"Exponential(0.0)", "Gamma(0.0, 1.0)", "Weibull(1.0, 0.0)", "Beta(1.0, 0.0)",
          "Geometric(0.0)", "Pareto(0.0, 1.0)", "Student(0.0)", "Gumbel(0.0, 0.0)",
          "Cauchy(0.0, 0.0)", "ChiSquare(0.0)", "Laplace(0.0, 0.0)", "Gompertz(0.0, 1.0)",
          "Kumaraswamy(0.0, 1.0)", "NegativeBinomial(0.0, 0.5)"})
        EXPECT_NE(told(faulty).find(always), std::string::npos) << faulty;
    EXPECT_NE(told("if ((Discrete(color, @red : 0.6, @green : 0.5, @blue : 0.0)) == @red) then 1.0 "
                   "else 0.0")
                  .find("must sum to 1, found 1.1"),
              std::string::npos);
    EXPECT_NE(told("if (exists_{?o : obj} [(Discrete_{?p : obj} (0.5)) == ?o]) then 1.0 else 0.0")
                  .find("must sum to 1, found 1.5"),
              std::string::npos);
}

TEST(CertainFaults, AreNotMadeByRounding) {
    const std::string one = "(0.3 + 0.4 + 0.1 - 0.3 - 0.4)";  // 1 - 9e-16 of 0.1
    for (const std::string& chance : std::vector{"0.1 / " + one, "1.0 - 0.1 / " + one}) {
        EXPECT_EQ(told("Bernoulli(" + chance + ")"), "") << chance;
        EXPECT_EQ(told("Binomial(3, " + chance + ")"), "") << chance;
    }
    EXPECT_EQ(told("Geometric(0.1 / " + one + ")"), "");
    EXPECT_EQ(told("NegativeBinomial(2.0, 0.1 / " + one + ")"), "");
    EXPECT_NE(told("Bernoulli(1.000000002)"), "");
    EXPECT_NE(told("Bernoulli(-0.000000002)"), "");
}

TEST(CertainFaults, AreToldOfOperators) {
    EXPECT_EQ(
        told("pow[2, 0 - 1]"),
        "pow's exponent must not be negative for int operands, found -1: this faults whenever "
        "it is evaluated");
    EXPECT_NE(told("gamma[0.0]"), "");
    EXPECT_EQ(told("pow[2, K]"), "");
}

TEST(CertainFaults, DependOnWhatTheInstanceFixes) {
    EXPECT_EQ(told("Bernoulli(K / 4.0)"), "");
    EXPECT_NE(told("Bernoulli(K / 3.0)"), "");
    EXPECT_EQ(told("Bernoulli(K / 3.0)", "K = 2;"), "");
    EXPECT_NE(told("Bernoulli(sum_{?o : obj} R(?o))"), "");
    EXPECT_EQ(told("Bernoulli(1.5 + x)"), "");
    EXPECT_EQ(told("Bernoulli(1.5 * Uniform(0.0, 1.0))"), "");
}

TEST(CertainFaults, AreThoseOfAllObjects) {
    const std::string each = "sum_{?o : obj} Bernoulli(R(?o))";
    EXPECT_EQ(told(each), "") << "R(b1) and R(b3) are 1";
    EXPECT_EQ(told(each, "R(b1) = 3.0; R(b3) = -4.0;"),
              "Bernoulli's probability must be in [0, 1], found 3: this faults whenever it is "
              "evaluated, for all objects");
}

TEST(CertainFaults, LieWhereARunMayGet) {
    EXPECT_EQ(told("if (K > 4) then Bernoulli(1.5) else 0.0"), "");
    EXPECT_EQ(told("0.0 * Bernoulli(1.5)"), "");
    EXPECT_NE(told("if (n > 4) then Bernoulli(1.5) else 0.0"), "");
}

TEST(CertainFaults, AreToldOnce) {
    EXPECT_EQ(told("Bernoulli(Normal(0.0, -1.0))"),
              "Normal's variance must not be negative, found -1: this faults whenever it is "
              "evaluated");
    EXPECT_EQ(told("Normal(gamma[0.0], 1.0)").find('\n'), std::string::npos);
}

TEST(CertainFaults, AreNoneOfValidParameters) {
    for (const char* valid :
         {"Bernoulli(1.0)", "Normal(0.0, 0.0)", "Uniform(1.0, 1.0)", "Poisson(0.0)",
          "Exponential(0.001)", "KronDelta(-7)", "DiracDelta(-7.0)",
          "NegativeBinomial(1.0, 0.000000000000000000000001)"})
        EXPECT_EQ(told(valid), "") << valid;
}

}  // namespace
}  // namespace rddlc
