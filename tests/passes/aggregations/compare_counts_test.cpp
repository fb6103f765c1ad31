#include "passes/aggregations/compare_counts.hpp"

#include "texts.hpp"

namespace rddlc {
namespace {

std::string compared(const std::string& cpf_of_x) {
    return of_x(cpf_of_x, passes::compare_counts).after;
}

TEST(CompareCounts, AsksHowManyThereAre) {
    EXPECT_EQ(compared("if (exists_{?o : obj} p(?o)) then x + sum_{?o : obj} p(?o) else 0.0"),
              "select(sum[o in obj](int(state.p[o])) > 0, "
              "state.x + real(sum[o in obj](int(state.p[o]))), 0.0)");
    EXPECT_EQ(compared("if (forall_{?o : obj} p(?o)) then x + sum_{?o : obj} ~p(?o) else 0.0"),
              "select(sum[o in obj](int(!state.p[o])) == 0, "
              "state.x + real(sum[o in obj](int(!state.p[o]))), 0.0)");
}

TEST(CompareCounts, LooksIntoNests) {
    EXPECT_EQ(compared("(exists_{?o : obj, ?u : obj} [p(?o) ^ NONE(?o, ?u)]) + x + "
                       "sum_{?o : obj, ?u : obj} [p(?o) ^ NONE(?o, ?u)]"),
              "real(sum[o in obj](sum[u in obj](int(state.p[o] && NONE[o, u]))) > 0) + state.x + "
              "real(sum[o in obj](sum[u in obj](int(state.p[o] && NONE[o, u]))))");
}

TEST(CompareCounts, LeavesWhatIsNotCounted) {
    for (const char* cpf :
         {"x + (exists_{?o : obj} p(?o))", "(exists_{?o : obj} p(?o)) + sum_{?o : obj} (x * p(?o))",
          "(forall_{?o : obj} p(?o)) + x + sum_{?o : obj} p(?o)",
          "(exists_{?o : obj} p(?o)) + x + sum_{?u : obj} p(?u)"}) {
        const Texts x = of_x(cpf, passes::compare_counts);
        EXPECT_EQ(x.before, x.after);
    }
}

}  // namespace
}  // namespace rddlc
