#include "passes/aggregations/order_objects.hpp"

#include "texts.hpp"

namespace rddlc {
namespace {

std::string ordering(const std::string& cpf_of_x) {
    return of_x(cpf_of_x, passes::order_objects).after;
}

TEST(OrderObjects, VisitsEachPairOnce) {
    EXPECT_EQ(ordering("forall_{?o : obj, ?q : obj} [?o == ?q | v(?o) ~= v(?q)]"),
              "real(forall[o in obj](forall[q in o + 1 .. 3](state.v[o] != state.v[q])))");
    EXPECT_EQ(ordering("exists_{?o : obj, ?q : obj} [p(?o) ^ p(?q) ^ ?q ~= ?o]"),
              "real(exists[o in obj](exists[q in o + 1 .. 3](state.p[o] && state.p[q])))");
}

TEST(OrderObjects, KnowsOperandsThatChangePlaces) {
    const std::string pair = "exists_{?o : obj, ?q : obj} [?o ~= ?q ^ ";
    for (const char* term : {"v(?o) + v(?q) < 1.0", "v(?o) * v(?q) < 1.0",
                             "(v(?o) < v(?q) | v(?q) < v(?o))", "(v(?o) < v(?q) | v(?o) > v(?q))",
                             "pow[v(?o) - v(?q), 2] + pow[x - v(?o), 2] * pow[x - v(?q), 2] < 1.0"})
        EXPECT_NE(ordering(pair + term + "]").find("o + 1 .. 3"), std::string::npos) << term;
}

// Equalities say of all values that they are equal, in whatever order.
TEST(OrderObjects, OrdersMoreThanTwo) {
    EXPECT_EQ(ordering("exists_{?o : obj, ?q : obj, ?r : obj} [?o ~= ?q ^ ?o ~= ?r ^ ?q ~= ?r ^ "
                       "v(?o) == v(?q) ^ v(?o) == v(?r)]"),
              "real(exists[o in obj](exists[q in o + 1 .. 3](exists[r in q + 1 .. 3]("
              "state.v[o] == state.v[q] && state.v[o] == state.v[r]))))");
    EXPECT_EQ(ordering("forall_{?o : obj, ?q : obj, ?r : obj} [?o == ?r | W(?q) * (v(?o) * v(?r)) "
                       "< 1.0]"),
              "real(forall[o in obj](forall[q in obj](forall[r in o + 1 .. 3]("
              "W[q] * (state.v[o] * state.v[r]) < 1.0))))");
}

// Terms that depend on the order, that count for equal objects, that draw, or that are summed.
TEST(OrderObjects, LeavesOthersAsTheyAre) {
    for (const char* cpf : {"exists_{?o : obj, ?q : obj} [?o ~= ?q ^ v(?o) < v(?q)]",
                            "exists_{?o : obj, ?q : obj} [?o ~= ?q ^ v(?o) - v(?q) < 1.0]",
                            "exists_{?o : obj, ?q : obj} [p(?o) ^ p(?q)]",
                            "exists_{?o : obj, ?q : obj} [?o ~= ?q ^ p(?o)]",
                            "exists_{?o : obj, ?q : obj} [?o ~= ?q ^ Bernoulli(0.5)]",
                            "sum_{?o : obj, ?q : obj} [?o ~= ?q ^ p(?o) ^ p(?q)]"}) {
        const Texts x = of_x(cpf, passes::order_objects);
        EXPECT_EQ(x.before, x.after);
    }
}

}  // namespace
}  // namespace rddlc
