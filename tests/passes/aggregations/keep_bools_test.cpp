#include "passes/aggregations/keep_bools.hpp"

#include "texts.hpp"

namespace rddlc {
namespace {

Texts kept(const std::string& cpf_of_x) {
    return of_x(cpf_of_x, passes::keep_bools);
}

TEST(KeepBools, JoinsProductsOfBools) {
    EXPECT_EQ(kept("(x > 1.0) * (x > 2.0)").after, "real(state.x > 1.0 && state.x > 2.0)");
    EXPECT_EQ(kept("sum_{?o : obj} [p(?o) * (x > 2.0) * (x < 3.0)]").after,
              "real(sum[o in obj](int(state.p[o] && state.x > 2.0 && state.x < 3.0)))");
}

TEST(KeepBools, TakesBoolsForComparisonsOfTheirNumbers) {
    EXPECT_EQ(kept("sum_{?o : obj} ((0 + p(?o)) == 1)").after,
              "real(sum[o in obj](int(state.p[o])))");
    EXPECT_EQ(kept("sum_{?o : obj} ((0 + p(?o)) < 1)").after,
              "real(sum[o in obj](int(!state.p[o])))");
}

TEST(KeepBools, LeavesOtherNumbers) {
    for (const char* cpf : {"(x > 1.0) * x", "x * x", "(x > 1.0) * Bernoulli(x)"}) {
        const Texts texts = kept(cpf);
        EXPECT_EQ(texts.before, texts.after);
    }
}

}  // namespace
}  // namespace rddlc
