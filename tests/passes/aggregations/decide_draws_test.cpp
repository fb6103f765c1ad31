#include "passes/aggregations/decide_draws.hpp"

#include "texts.hpp"

namespace rddlc {
namespace {

Texts decided(const std::string& cpf_of_x) {
    return of_x(cpf_of_x, passes::decide_draws);
}

TEST(DecideDraws, TakesConditionsForProducts) {
    EXPECT_EQ(decided("Bernoulli(1.0 - prod_{?o : obj} [1.0 - p(?o)])").after,
              "real(!forall[o in obj](!state.p[o]))");
    EXPECT_EQ(decided("Bernoulli(prod_{?o : obj} [1.0 - p(?o) * (v(?o) > 0.0)])").after,
              "real(forall[o in obj](!(state.p[o] && state.v[o] > 0.0)))");
    EXPECT_EQ(decided("Bernoulli(if (x > 1.0) then 1.0 - (x > 2.0) else 0.0)").after,
              "real(select(state.x > 1.0, !(state.x > 2.0), false))");
}

// The instance decides whether a table is one of zeros and ones.
TEST(DecideDraws, KnowsTables) {
    const auto drawn_by_table = [](const char* non_fluents) {
        Problem problem = with_tables("sum_{?o : obj} Bernoulli(W(?o) * p(?o))");
        problem.non_fluents = non_fluents;
        return of_x(grounded(problem), passes::decide_draws);
    };
    EXPECT_EQ(drawn_by_table("W(b2) = 0.0;").after,
              "real(sum[o in obj](int(W[o] == 1.0 && state.p[o])))");
    const Texts other = drawn_by_table("W(b2) = 0.5;");
    EXPECT_EQ(other.before, other.after);
}

TEST(DecideDraws, LeavesWhatMayBeAnotherNumberOrFault) {
    for (const char* cpf :
         {"Bernoulli(0.5 * (x > 1.0))", "Bernoulli(1.0 - x)", "Bernoulli(prod_{?o : obj} [v(?o)])",
          "Bernoulli(sum_{?o : obj} [p(?o)])", "Bernoulli((x > 1.0) + (x > 2.0))",
          "Bernoulli(2.0 - (x > 1.0))", "Bernoulli(1.0 * Bernoulli(0.5) * (x > 1.0))"}) {
        const Texts texts = decided(cpf);
        EXPECT_EQ(texts.before, texts.after);
    }
}

}  // namespace
}  // namespace rddlc
