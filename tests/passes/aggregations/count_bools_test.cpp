#include "passes/aggregations/count_bools.hpp"

#include "texts.hpp"

namespace rddlc {
namespace {

std::string counted(const std::string& cpf_of_x) {
    return of_x(cpf_of_x, passes::count_bools).after;
}

TEST(CountBools, AddsIntsInsteadOfReals) {
    EXPECT_EQ(counted("x + sum_{?o : obj} [2.5 * p(?o)]"),
              "state.x + 2.5 * real(sum[o in obj](int(state.p[o])))");
    EXPECT_EQ(counted("x + sum_{?o : obj} [p(?o) * 3.0 * 2.0]"),
              "state.x + 6.0 * real(sum[o in obj](int(state.p[o])))");
}

TEST(CountBools, CountsEachTermOfTheSum) {
    EXPECT_EQ(counted("x + sum_{?o : obj} [1.0 * p(?o) - 0.75 * ~p(?o)]"),
              "state.x + (real(sum[o in obj](int(state.p[o]))) - "
              "0.75 * real(sum[o in obj](int(!state.p[o]))))");
}

TEST(CountBools, GivesNoNegativeZero) {
    EXPECT_EQ(counted("x + sum_{?o : obj} [-5.0 * p(?o)]"),
              "state.x + (0.0 - 5.0 * real(sum[o in obj](int(state.p[o]))))");
}

TEST(CountBools, CountsSumsOfCounts) {
    EXPECT_EQ(counted("x + sum_{?o : obj} [sum_{?q : obj} [-1.5 * (p(?o) ^ p(?q))]]"),
              "state.x + (0.0 - 1.5 * real(sum[o in obj](sum[q in obj]("
              "int(state.p[o] && state.p[q])))))");
}

TEST(CountBools, LeavesOtherSums) {
    for (const char* cpf :
         {"sum_{?o : obj} [v(?o)]", "sum_{?o : obj} [x * p(?o)]", "sum_{?o : obj} [W(?o) * p(?o)]",
          "sum_{?o : obj} [1.0 + p(?o)]", "sum_{?o : obj} [0.1 * p(?o)]",
          "sum_{?o : obj} [10000000000.0 * p(?o)]", "sum_{?o : obj} [10.0 * (0.1 * p(?o))]",
          "sum_{?o : obj} [8.0 * (0.125 * p(?o) * 10000000000.0) / 10000000000.0]",
          "prod_{?o : obj} [2.5 * p(?o)]"}) {
        const Texts x = of_x(cpf, passes::count_bools);
        EXPECT_EQ(x.before, x.after);
    }
}

}  // namespace
}  // namespace rddlc
