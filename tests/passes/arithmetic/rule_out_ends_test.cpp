#include "passes/arithmetic/rule_out_ends.hpp"

#include "texts.hpp"

#include <string>

namespace rddlc {
namespace {

struct Ends {
    std::string termination, cpf_of_x, reward = "x";
};

ir::Program without_ends(const Ends& ends) {
    const Problem problem{.pvariables =
                              "x : { state-fluent, real, default = 0.0 };\n"
                              "over : { state-fluent, bool, default = false };\n"
                              "p(obj) : { state-fluent, bool, default = false };",
                          .cpfs = "x' = " + ends.cpf_of_x + ";\nover' = over;\np'(?o) = p(?o);",
                          .reward = ends.reward,
                          .blocks = "termination { " + ends.termination + "; };"};
    passes::Report report;
    return valid(passes::rule_out_ends(grounded(problem), report));
}

// The right-hand side of the CPF of x.
std::string x_with(const std::string& termination, const std::string& cpf_of_x) {
    return value_of_x(without_ends({termination, cpf_of_x}));
}

TEST(RuleOutEnds, TakesEachConditionForFalse) {
    EXPECT_EQ(x_with("x > 2.0", "if (x > 2.0) then 7.0 else x + 1.0"), "state.x + 1.0");
    EXPECT_EQ(x_with("x < -1.0 | x > 2.0", "if (x > 2.0) then 7.0 else x + 1.0"), "state.x + 1.0");
    EXPECT_EQ(x_with("x > 2.0; over", "if (over | x > 2.0) then 7.0 else x + 1.0"),
              "state.x + 1.0");
}

TEST(RuleOutEnds, TakesWhatANegatedOneTestsForTrue) {
    EXPECT_EQ(x_with("~over", "if (over) then x else 7.0"), "state.x");
    EXPECT_EQ(x_with("x > 2.0 | ~over", "if (over) then x else 7.0"), "state.x");
}

TEST(RuleOutEnds, OfAllObjects) {
    EXPECT_EQ(x_with("exists_{?o : obj} [p(?o)]", "if (exists_{?o : obj} [p(?o)]) then 7.0 else x"),
              "state.x");
}

TEST(RuleOutEnds, InTheReward) {
    const ir::Program program = without_ends(
        {.termination = "x > 2.0", .cpf_of_x = "x", .reward = "if (x > 2.0) then 7.0 else 1.0"});
    EXPECT_NE(ir::print(program).find("reward = 1.0"), std::string::npos);
    EXPECT_NE(ir::print(program).find("state.x > 2.0"), std::string::npos)
        << "the termination is tested as before";
}

TEST(RuleOutEnds, LeavesOtherConditions) {
    // Both parts of a conjunction may hold, if not together.
    EXPECT_EQ(x_with("over ^ x > 2.0", "if (x > 2.0) then 7.0 else x"),
              "select(state.x > 2.0, 7.0, state.x)");
    EXPECT_EQ(x_with("x > 2.0", "if (x > 3.0) then 7.0 else x"),
              "select(state.x > 3.0, 7.0, state.x)");
    // Nan is neither above nor at most 2.
    EXPECT_EQ(x_with("x > 2.0", "if (x <= 2.0) then 7.0 else x"),
              "select(state.x <= 2.0, 7.0, state.x)");
}

TEST(RuleOutEnds, LeavesConstants) {
    EXPECT_EQ(x_with("true", "if (over) then 7.0 else x"), "select(state.over, 7.0, state.x)");
}

}  // namespace
}  // namespace rddlc
