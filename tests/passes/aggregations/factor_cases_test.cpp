#include "passes/aggregations/factor_cases.hpp"

#include "texts.hpp"

#include <string>

namespace rddlc {
namespace {

// The CPF of x after the pass. The rank is one of three colors.
std::string factored_cases(const std::string& cpf_of_x) {
    Problem problem = with_tables(cpf_of_x);
    problem.pvariables +=
        "\nrank : { state-fluent, color, default = @red };\n"
        "n : { state-fluent, int, default = 0 };";
    problem.cpfs += " rank' = rank; n' = n;";
    return of_x(grounded(problem), passes::factor_cases).after;
}

TEST(FactorCases, AsksOnceWhatAllCasesAsk) {
    EXPECT_EQ(
        factored_cases("if (x > 1.0 ^ n == 1) then 3.0 else if (x > 1.0 ^ n == 5) then -x else "
                       "if (x > 1.0 ^ n == 2) then Uniform(0.0, 1.0) else 0.5"),
        "select(state.x > 1.0, select(state.n == 1, 3.0, select(state.n == 5, -state.x, "
        "select(state.n == 2, sample uniform@0[0](0.0, 1.0), 0.5))), 0.5)");
}

TEST(FactorCases, NeedsNoTestOfTheLastValue) {
    EXPECT_EQ(
        factored_cases("if (rank == @red ^ x > 1.0) then 3.0 else if (rank == @blue ^ x > 1.0) "
                       "then 4.0 else if (rank == @green ^ x > 1.0) then 6.0 else 0.5"),
        "select(state.x > 1.0, select(state.rank == 0, 3.0, select(state.rank == 2, 4.0, "
        "6.0)), 0.5)");
}

// Two cases; other conditions; another int; conditions that draw; a dear value of no case.
TEST(FactorCases, LeavesOthersAsTheyAre) {
    for (const std::string cases :
         {"if (x > 1.0 ^ n == 1) then 3.0 else if (x > 1.0 ^ n == 2) then 4.0 else 0.5",
          "if (x > 1.0 ^ n == 1) then 3.0 else if (x > 2.0 ^ n == 2) then 4.0 else "
          "if (x > 1.0 ^ n == 3) then 6.0 else 0.5",
          "if (x > 1.0 ^ n == 1) then 3.0 else if (x > 1.0 ^ rank == @blue) then 4.0 else "
          "if (x > 1.0 ^ n == 3) then 6.0 else 0.5",
          "if (Bernoulli(0.5) ^ n == 1) then 3.0 else if (Bernoulli(0.5) ^ n == 2) then 4.0 else "
          "if (Bernoulli(0.5) ^ n == 3) then 6.0 else 0.5",
          "if (x > 1.0 ^ n == 1) then 3.0 else if (x > 1.0 ^ n == 2) then 4.0 else "
          "if (x > 1.0 ^ n == 3) then 6.0 else exp[x] * exp[-x]"}) {
        const std::string text = factored_cases(cases);
        EXPECT_NE(text.find("state.x > 1.0 && "), text.find("sample")) << text;
    }
}

}  // namespace
}  // namespace rddlc
