#include "passes/aggregations/count_values.hpp"

#include "passes/aggregations/skip_unchosen_sums.hpp"
#include "texts.hpp"

#include <string>

namespace rddlc {
namespace {

// The reward after the pass, of cases that a step may jump over. Three objects show colors.
std::string counted_values(const std::string& cases) {
    const Problem problem{.pvariables =
                              "shown(obj) : { state-fluent, color, default = @red };\n"
                              "x : { state-fluent, real, default = 0.0 };\n"
                              "take(color) : { action-fluent, bool, default = false };\n"
                              "wait(obj, obj) : { action-fluent, bool, default = false };",
                          .cpfs = "shown'(?o) = shown(?o); x' = x;",
                          .reward = cases};
    passes::Report report;
    ir::Program program = passes::skip_unchosen_sums(of_moderate_values(problem), report);
    const std::string text = ir::print(valid(passes::count_values(std::move(program), report)));
    const std::string start = "reward = ";
    const std::size_t begin = text.find(start) + start.size();
    return text.substr(begin, text.find('\n', begin) - begin);
}

// Conditions that are dear_condition, so that a step jumps over the cases.
const std::string dear_condition =
    "(sum_{?o : obj, ?p : obj, ?q : obj} [shown(?o) == shown(?p) ^ shown(?p) == shown(?q)]) > 9";
std::string shown_count(const std::string& color) {
    return "(sum_{?o : obj} [shown(?o) == @" + color + "])";
}

TEST(CountValues, SharesCountsInCases) {
    const std::string reward = counted_values(
        "if (take(@red) ^ " + dear_condition + ") then " + shown_count("red") +
        " else if (take(@green)) then " + shown_count("green") +
        " else if (take(@blue) ^ forall_{?o : obj} [shown(?o) ~= @blue]) then 1 else 0");
    const std::string fields = "sum[counted in 0 .. 3](reward-field[state.shown[counted]])";
    EXPECT_NE(reward.find("bit_and(" + fields + ", 3)"), std::string::npos) << reward;
    EXPECT_NE(reward.find("bit_and(shift_right(" + fields + ", 3), 3)"), std::string::npos)
        << reward;
    EXPECT_NE(reward.find("bit_and(" + fields + ", 192) == 0"), std::string::npos) << reward;
}

TEST(CountValues, LeavesFewValues) {
    const std::string reward =
        counted_values("if (take(@red) ^ " + dear_condition + ") then " + shown_count("red") +
                       " else if (take(@green)) then " + shown_count("green") + " else 0");
    EXPECT_NE(reward.find("by a jump"), std::string::npos) << reward;
    EXPECT_EQ(reward.find("counted"), std::string::npos) << reward;
}

TEST(CountValues, LeavesWhatNoStepJumpsOver) {
    const std::string reward = counted_values(
        shown_count("red") + " * x + " + shown_count("green") + " + 2 * " + shown_count("blue"));
    EXPECT_EQ(reward.find("counted"), std::string::npos) << reward;
}

}  // namespace
}  // namespace rddlc
