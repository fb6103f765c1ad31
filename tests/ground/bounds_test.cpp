#include "problem.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace rddlc {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
using Doubles = std::vector<double>;

Problem with_preconditions(const std::string& conditions) {
    return {.pvariables =
                "CAP(obj) : { non-fluent, real, default = 10.0 };\n"
                "N : { non-fluent, int, default = 3 };\n"
                "x : { state-fluent, real, default = 1.0 };\n"
                "tank(obj) : { state-fluent, real, default = 1.0 };\n"
                "flow(obj) : { action-fluent, real, default = 0.0 };\n"
                "move(obj, pair) : { action-fluent, real, default = 0.0 };\n"
                "mix(color) : { action-fluent, real, default = 0.0 };\n"
                "count : { action-fluent, int, default = 1 };\n"
                "go : { action-fluent, bool, default = false };",
            .cpfs = "x' = x;\ntank'(?o) = tank(?o);",
            .blocks = "action-preconditions {\n" + conditions + "\n};",
            .non_fluents = "CAP(b2) = 20.0;"};
}

ir::Fluent fluent(const ir::Program& program, const std::string& name) {
    return *std::ranges::find(program.fluents, name, &ir::Fluent::name);
}

ir::Fluent bounded(const std::string& name, const std::string& conditions) {
    return fluent(grounded(with_preconditions(conditions)), name);
}

TEST(Bounds, AreReadForEachGrounding) {
    const ir::Fluent flow =
        bounded("flow", "forall_{?o : obj} [flow(?o) >= 0 ^ flow(?o) <= CAP(?o) / 2];");
    EXPECT_EQ(*flow.lower, (Doubles{0, 0, 0}));
    EXPECT_EQ(*flow.upper, (Doubles{5, 10, 5}));
}

TEST(Bounds, AreInfiniteWithoutConstraint) {
    const ir::Fluent flow = bounded("flow", "forall_{?o : obj} flow(?o) >= 0;");
    EXPECT_EQ(*flow.upper, Doubles(3, infinity));
    EXPECT_EQ(*bounded("count", "go | ~go;").lower, Doubles{-infinity});
}

TEST(Bounds, AreForNumericStateAndActionFluentsOnly) {
    const ir::Program program = grounded(with_preconditions("go;"));
    EXPECT_TRUE(fluent(program, "go").lower->empty());
    EXPECT_TRUE(fluent(program, "CAP").upper->empty());
    EXPECT_EQ(fluent(program, "tank").lower->size(), 3u);
}

TEST(Bounds, ComeFromBothSidesOfAComparison) {
    const ir::Fluent flow = bounded("flow",
                                    "forall_{?o : obj} [-1 <= flow(?o)];\n"
                                    "forall_{?o : obj} [CAP(?o) >= flow(?o)];");
    EXPECT_EQ(*flow.lower, Doubles(3, -1));
    EXPECT_EQ(*flow.upper, (Doubles{10, 20, 10}));
}

TEST(Bounds, StrictOnesMoveToTheNextInt) {
    const ir::Fluent above = bounded("count", "count > 0; count < 5;");
    EXPECT_EQ(*above.lower, Doubles{1});
    EXPECT_EQ(*above.upper, Doubles{4});
    const ir::Fluent fraction = bounded("count", "count > 0.5; count < N + 0.5;");
    EXPECT_EQ(*fraction.lower, Doubles{1});
    EXPECT_EQ(*fraction.upper, Doubles{3});
}

TEST(Bounds, RoundInwardForInts) {
    const ir::Fluent count = bounded("count", "count >= 0.5; count <= 4.7;");
    EXPECT_EQ(*count.lower, Doubles{1});
    EXPECT_EQ(*count.upper, Doubles{4});
}

TEST(Bounds, StrictOnesMoveALittleForReals) {
    const ir::Fluent flow = bounded("flow", "forall_{?o : obj} flow(?o) > 0;");
    EXPECT_EQ(*flow.lower, Doubles(3, 1e-5));
}

TEST(Bounds, TheTightestWins) {
    const ir::Fluent flow = bounded("flow",
                                    "forall_{?o : obj} flow(?o) <= 15;\n"
                                    "forall_{?o : obj} flow(?o) <= CAP(?o);");
    EXPECT_EQ(*flow.upper, (Doubles{10, 15, 10}));
}

TEST(Bounds, FollowTheOrderOfTheArguments) {
    const ir::Fluent move = bounded(
        "move",
        "forall_{?p : pair, ?o : obj} move(?o, ?p) <= CAP(?o) + (if (?p == ?p) then 1 else 2);");
    EXPECT_EQ(*move.upper, (Doubles{11, 11, 21, 21, 11, 11}));
}

TEST(Bounds, OfASingleMember) {
    EXPECT_EQ(*bounded("mix", "mix(@green) <= 3;").upper, (Doubles{infinity, 3, infinity}));
}

TEST(Bounds, IgnoreWhatIsNotAConstraintOfOneFluent) {
    for (const char* condition :
         {"forall_{?o : obj} [flow(?o) <= x];", "forall_{?o : obj} [2 * flow(?o) <= 1];",
          "forall_{?o : obj} [flow(?o) <= 1 | go];", "exists_{?o : obj} [flow(?o) <= 1];",
          "forall_{?o : obj} [go => flow(?o) <= 1];", "forall_{?o : obj} [flow(?o) == 1];",
          "[sum_{?o : obj} flow(?o)] <= 1;"}) {
        EXPECT_EQ(*bounded("flow", condition).upper, Doubles(3, infinity)) << condition;
    }
}

TEST(Bounds, OfStateFluentsComeFromInvariants) {
    Problem problem = with_preconditions("forall_{?o : obj} tank(?o) <= 1;");
    problem.blocks +=
        "\nstate-invariants { forall_{?o : obj} [tank(?o) >= 0 ^ tank(?o) <= CAP(?o)]; };";
    const ir::Fluent tank = fluent(grounded(problem), "tank");
    EXPECT_EQ(*tank.lower, Doubles(3, 0));
    EXPECT_EQ(*tank.upper, (Doubles{10, 20, 10}));
}

TEST(Bounds, LeaveNoTraceInTheProgram) {
    const ir::Program program =
        grounded(with_preconditions("forall_{?o : obj} flow(?o) <= pow[N, 2];"));
    EXPECT_EQ(*fluent(program, "flow").upper, Doubles(3, 9));
    EXPECT_EQ(program.sites.size(), 1u);
}

TEST(Bounds, ThatContradictEachOtherAreErrors) {
    const Grounded result = ground_text(with_preconditions("forall_{?o : obj} flow(?o) >= 15;\n"
                                                           "forall_{?o : obj} flow(?o) <= CAP(?o);")
                                            .text());
    EXPECT_FALSE(result.program);
    EXPECT_NE(result.messages.find("error: no value of 'flow(b1)' satisfies the constraints: it "
                                   "must be at least 15 and at most 10 [E0602]"),
              std::string::npos)
        << result.messages;
}

}  // namespace
}  // namespace rddlc
