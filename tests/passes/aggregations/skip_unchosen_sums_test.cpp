#include "passes/aggregations/skip_unchosen_sums.hpp"

#include "texts.hpp"

#include <vector>

namespace rddlc {
namespace {

constexpr const char* four_tables =
    "sell(obj) : { action-fluent, bool, default = false };\n"
    "ship(obj, obj) : { action-fluent, bool, default = false };\n"
    "build(obj) : { action-fluent, bool, default = false };\n"
    "hire : { action-fluent, bool, default = false };\n";

// The reward after the pass. Prices of the objects are v(?o), which stay finite.
std::string reward_that_skips(const std::string& reward, const std::string& actions = four_tables) {
    Problem problem = with_tables("0.0");
    problem.pvariables += "\n" + actions;
    problem.reward = reward;
    passes::Report report;
    const ir::Program program =
        valid(passes::skip_unchosen_sums(of_moderate_values(problem), report));
    const std::string text = ir::print(program);
    const std::size_t begin = text.find("reward = ");
    return text.substr(begin, text.find('\n', begin) - begin);
}

const std::string dear_term = "cos[v(?o)] * pow[v(?o) * v(?o), 0.5]";
const std::string dear_text = "cos(state.v[o]) * power(state.v[o] * state.v[o], 0.5)";

TEST(SkipUnchosenSums, TestsTheTableThatChooses) {
    const std::string sum = "sum[o in obj](" + dear_text + " * real(action.sell[o]))";
    EXPECT_EQ(reward_that_skips("x - sum_{?o : obj} [" + dear_term + " * sell(?o)]"),
              "reward = state.x - select by a jump(bits(action.sell, 0) != 0, " + sum + ", 0.0)");
}

// A table of a condition that the other one decides is not tested.
TEST(SkipUnchosenSums, TestsAsFewTablesAsItTakes) {
    const std::string reward = reward_that_skips("sum_{?o : obj, ?p : obj} [" + dear_term +
                                                 " * (ship(?o, ?p) ^ ~build(?o))]");
    EXPECT_EQ(reward.find("reward = select by a jump(bits(action.ship, 0) != 0, sum["), 0u)
        << reward;
}

// Sums that are cheap, may be inf or nan, draw, or count more than what is chosen.
TEST(SkipUnchosenSums, LeavesOtherSums) {
    for (const std::string& term :
         std::vector<std::string>{"v(?o) * sell(?o)", "exp[exp[v(?o)]] * sell(?o)",
                                  "Normal(0.0, 1.0) * " + dear_term + " * sell(?o)",
                                  dear_term + " * (1.0 - sell(?o))"}) {
        const std::string reward = reward_that_skips("sum_{?o : obj} [" + term + "]");
        EXPECT_EQ(reward.find("by a jump"), std::string::npos) << reward;
    }
}

// Dear conditions are left to what they give where the table chooses nothing.
TEST(SkipUnchosenSums, TestsCasesOfOneTable) {
    const auto cases = [](const std::string& term, const std::string& rest) {
        std::string chain = rest;
        for (const char* value : {"1", "2", "3"})
            chain = std::string("if (exists_{?o : obj} [sell(?o) ^ ") + term + " > " + value +
                    "]) then " + value + " else " + chain;
        return reward_that_skips(chain);
    };
    const std::string skips = "reward = real(select by a jump(bits(action.sell, 0) != 0, ";
    EXPECT_EQ(cases(dear_term, "0").find(skips), 0u) << cases(dear_term, "0");
    EXPECT_EQ(cases("v(?o)", "0").find(skips), std::string::npos);
    EXPECT_EQ(cases(dear_term, "round[x * x * x]").find(skips), std::string::npos);
}

// Such an action mostly chooses something.
TEST(SkipUnchosenSums, LeavesSumsOfActionsWithFewTables) {
    const std::string reward =
        reward_that_skips("sum_{?o : obj} [" + dear_term + " * sell(?o)]",
                          "sell(obj) : { action-fluent, bool, default = false };\n"
                          "hire : { action-fluent, bool, default = false };");
    EXPECT_EQ(reward.find("by a jump"), std::string::npos) << reward;
}

}  // namespace
}  // namespace rddlc
