#include "passes/aggregations/skip_zero_terms.hpp"

#include "texts.hpp"

namespace rddlc {
namespace {

std::string skipping(const std::string& cpf_of_x) {
    return of_moderate_x(cpf_of_x, passes::skip_zero_terms).after;
}

TEST(SkipZeroTerms, ComputesOnlyTermsThatCount) {
    EXPECT_EQ(skipping("sum_{?o : obj} [cos[v(?o)] * p(?o)]"),
              "sum[o in obj](select(state.p[o], cos(state.v[o]), 0.0))");
    EXPECT_EQ(skipping("sum_{?o : obj} [p(?o) * (1.0 - pow[v(?o) * v(?o), 0.5])]"),
              "sum[o in obj](select(state.p[o], 1.0 - power(state.v[o] * state.v[o], 0.5), 0.0))");
    EXPECT_EQ(skipping("sum_{?o : obj} [p(?o) * pow[sum_{?q : obj} [v(?q) * v(?q)], 0.5]]"),
              "sum[o in obj](select(state.p[o], "
              "power(sum[q in obj](state.v[q] * state.v[q]), 0.5), 0.0))");
}

// Factors that the sum does not change are computed before it, also if the bool stands inside.
TEST(SkipZeroTerms, FindsFactorsThatTheSumDoesNotChange) {
    EXPECT_EQ(
        skipping("sum_{?o : obj} [p(?o) * x * (x + 0.5) * (2.0 - x)]"),
        "sum[o in obj](select(state.p[o], state.x * (state.x + 0.5) * (2.0 - state.x), 0.0))");
    EXPECT_EQ(skipping("sum_{?o : obj} [p(?o) * 3 * cos[x]]"),
              "sum[o in obj](select(state.p[o], 3.0 * cos(state.x), 0.0))");
}

// Emitted code visits the true bools of a row alone, so that cheap terms are also worth it.
TEST(SkipZeroTerms, ComputesAlsoCheapTermsOfRows) {
    const auto skipping_rows = [](const std::string& cpf_of_x) {
        Problem problem = with_tables(cpf_of_x);
        problem.pvariables += "\nq(obj, obj) : { state-fluent, bool, default = false };";
        problem.cpfs += "\nq'(?o, ?r) = q(?o, ?r);";
        problem.non_fluents.clear();
        const ir::Program program = grounded_with_many(problem);
        return of_x(program.moderate ? **program.moderate : program, passes::skip_zero_terms).after;
    };
    EXPECT_EQ(skipping_rows("sum_{?o : obj} [v(?o) * p(?o)]"),
              "sum[o in obj](select(state.p[o], state.v[o], 0.0))");
    EXPECT_EQ(skipping_rows("sum_{?r : obj, ?o : obj} [-0.5 * q(?r, ?o)]"),
              "sum[r in obj](sum[o in obj](select(state.q[r, o], -0.5, 0.0)))");
    EXPECT_EQ(skipping_rows("sum_{?r : obj, ?o : obj} [v(?o) * q(?o, ?r)]"),
              "sum[r in obj](sum[o in obj](state.v[o] * real(state.q[o, r])))");
}

// Nor does it visit false bools of a table of two dimensions, if few are true.
TEST(SkipZeroTerms, ComputesAlsoCheapTermsOfTablesWithFewTrueBools) {
    const auto skipping_table = [](const std::string& init_state) {
        Problem problem = with_tables("sum_{?r : obj, ?o : obj} [v(?o) * q(?o, ?r)]");
        problem.pvariables += "\nq(obj, obj) : { state-fluent, bool, default = false };";
        problem.cpfs += "\nq'(?o, ?r) = q(?o, ?r);";
        problem.non_fluents.clear();
        problem.init_state = init_state;
        const ir::Program program = grounded_with_many(problem);
        return of_x(program.moderate ? **program.moderate : program, passes::skip_zero_terms).after;
    };
    EXPECT_EQ(skipping_table("q(b1, b2) = true;"),
              "sum[r in obj](sum[o in obj](select(state.q[o, r], state.v[o], 0.0)))");
    EXPECT_EQ(skipping_table(""), "sum[r in obj](sum[o in obj](state.v[o] * real(state.q[o, r])))");
}

// Terms are left if they are cheap, may be inf or nan, draw, or are not part of a sum.
TEST(SkipZeroTerms, LeavesOtherTerms) {
    for (const char* cpf :
         {"sum_{?o : obj} [v(?o) * p(?o)]", "sum_{?o : obj} [exp[v(?o)] * p(?o)]",
          "sum_{?o : obj} [p(?o) * pow[v(?o), 0.5]]", "sum_{?o : obj} [Normal(x, 1.0) * p(?o)]",
          "prod_{?o : obj} [cos[v(?o)] * p(?o)]"}) {
        const Texts x = of_moderate_x(cpf, passes::skip_zero_terms);
        EXPECT_EQ(x.before, x.after);
    }
}

}  // namespace
}  // namespace rddlc
