#include "passes/aggregations/separate_objects.hpp"

#include "texts.hpp"

namespace rddlc {
namespace {

std::string separated(const std::string& cpf_of_x) {
    return of_x(cpf_of_x, passes::separate_objects).after;
}

TEST(SeparateObjects, AsksForEachAloneWhereValuesTellThemApart) {
    EXPECT_EQ(separated("exists_{?o : obj, ?q : obj} [?o ~= ?q ^ E(?o) == 1 ^ E(?q) == 2 ^ p(?q)]"),
              "real(exists[o in obj](E[o] == 1) && exists[o in obj](E[o] == 2 && state.p[o]))");
    EXPECT_EQ(separated("forall_{?o : obj, ?q : obj} [?q == ?o | E(?o) ~= 1 | E(?q) ~= 2]"),
              "real(forall[o in obj](E[o] != 1) || forall[o in obj](E[o] != 2))");
}

TEST(SeparateObjects, TakesCasesApart) {
    EXPECT_EQ(separated("exists_{?o : obj, ?q : obj} [?o ~= ?q ^ x > 0.0 ^ "
                        "((E(?o) == 1 ^ E(?q) == 2) | (E(?o) == 2 ^ E(?q) == 3))]"),
              "real(state.x > 0.0 && exists[o in obj](E[o] == 1) && exists[o in obj](E[o] == 2) || "
              "state.x > 0.0 && exists[o in obj](E[o] == 2) && exists[o in obj](E[o] == 3))");
}

// One object may be both, two variables may be one object, values may be equal; or something draws.
TEST(SeparateObjects, LeavesOthersAsTheyAre) {
    for (const char* cpf :
         {"exists_{?o : obj, ?q : obj} [?o ~= ?q ^ E(?o) == 1 ^ E(?q) == 1]",
          "exists_{?o : obj, ?q : obj} [?o ~= ?q ^ E(?o) == 1 ^ v(?q) == 2.0]",
          "exists_{?o : obj, ?q : obj} [E(?o) == 1 ^ E(?q) == 2]",
          "exists_{?o : obj, ?q : obj} [?o ~= ?q ^ E(?o) == 1 ^ E(?q) == 2 ^ v(?o) < v(?q)]",
          "exists_{?o : obj, ?q : obj} [?o ~= ?q ^ E(?o) == 1 ^ E(?q) == 2 ^ Bernoulli(0.5)]",
          "exists_{?o : obj, ?q : obj, ?r : obj} "
          "[?o ~= ?q ^ ?o ~= ?r ^ ?q ~= ?r ^ E(?o) == 1 ^ E(?q) == 2 ^ E(?r) == 2]"}) {
        const Texts x = of_x(cpf, passes::separate_objects);
        EXPECT_EQ(x.before, x.after);
    }
}

}  // namespace
}  // namespace rddlc
