#include "passes/aggregations/factor_quantifiers.hpp"

#include "texts.hpp"

namespace rddlc {
namespace {

std::string factoring(const std::string& cpf_of_x) {
    return of_x(cpf_of_x, passes::factor_quantifiers).after;
}

TEST(FactorQuantifiers, LeavesOutWhatDoesNotChange) {
    EXPECT_EQ(factoring("exists_{?o : obj} [p(?o) ^ x > 2.0 ^ cos[v(?o)] > 0.5]"),
              "real(state.x > 2.0 && exists[o in obj](state.p[o] && cos(state.v[o]) > 0.5))");
    EXPECT_EQ(factoring("forall_{?o : obj} [cos[v(?o)] > 0.5 | x > 2.0 | p(?o)]"),
              "real(state.x > 2.0 || forall[o in obj](cos(state.v[o]) > 0.5 || state.p[o]))");
}

TEST(FactorQuantifiers, LeavesOutOfEachVariable) {
    EXPECT_EQ(factoring("exists_{?o : obj, ?q : obj} [cos[v(?q)] > v(?o) ^ p(?o)]"),
              "real(exists[o in obj](state.p[o] && exists[q in obj](cos(state.v[q]) > "
              "state.v[o])))");
}

// A rest that reads bools alone, one that may fault, and the terms of a sum.
TEST(FactorQuantifiers, LeavesOthersAsTheyAre) {
    for (const char* cpf : {"exists_{?o : obj} [p(?o) ^ x > 2.0]",
                            "exists_{?o : obj} [round[v(?o) * 0.3] > 1 ^ x > 2.0]",
                            "sum_{?o : obj} [cos[v(?o)] > 0.5 ^ x > 2.0]",
                            "exists_{?o : obj} [cos[v(?o)] > 0.5 | x > 2.0]"}) {
        const Texts x = of_x(cpf, passes::factor_quantifiers);
        EXPECT_EQ(x.before, x.after);
    }
}

}  // namespace
}  // namespace rddlc
