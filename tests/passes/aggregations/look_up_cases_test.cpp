#include "passes/aggregations/look_up_cases.hpp"

#include "texts.hpp"

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace rddlc {
namespace {

// The action names colors, and a rank moves by how many objects have one of them.
ir::Program after(const std::string& cpf_of_rank) {
    const Problem problem{
        .pvariables =
            "UP(color) : { non-fluent, color, default = @blue };\n"
            "DOWN(color) : { non-fluent, color, default = @red };\n"
            "TURNED(color) : { non-fluent, color, default = @green };\n"
            "shown(obj) : { state-fluent, color, default = @red };\n"
            "rank : { state-fluent, color, default = @red };\n"
            "other : { state-fluent, color, default = @red };\n"
            "reds : { action-fluent, bool, default = false };\n"
            "greens : { action-fluent, bool, default = false };",
        .cpfs = "shown'(?o) = shown(?o); other' = other; rank' = " + cpf_of_rank + ";",
        .non_fluents =
            "UP(@red) = @green; DOWN(@blue) = @green; TURNED(@red) = @blue; "
            "TURNED(@blue) = @red;"};
    passes::Report report;
    return valid(passes::look_up_cases(grounded(problem), report));
}

std::string count_of(const std::string& color) {
    return "(sum_{?o : obj} [shown(?o) == @" + color + "])";
}
// Whether an object count is met, by a color that the action names.
std::string met(const std::string& count) {
    return "((reds ^ " + count_of("red") + " == " + count + ") | (greens ^ " + count_of("green") +
           " == " + count + "))";
}
std::string chain(const std::vector<std::string>& conditions) {
    const std::vector<std::string> values{"UP(rank)", "DOWN(rank)", "TURNED(rank)"};
    std::string text = "rank";
    for (std::size_t k = conditions.size(); k-- > 0;)
        text = "if " + conditions[k] + " then " + values[k] + " else " + text;
    return text;
}

std::vector<std::int64_t> values_of(const ir::Program& program, const std::string& name) {
    std::vector<std::int64_t> values;
    for (const ir::Buffer& buffer : program.buffers)
        if (buffer.name == name)
            for (std::int64_t k = 0; k < buffer.count(); ++k)
                values.push_back(std::get<std::int64_t>(buffer.values[k]));
    return values;
}

TEST(LookUpCases, ChoosesByTheBitsOfCounts) {
    const ir::Program program = after(chain({met("2"), met("0"), met("3")}));
    const auto term = [](const std::string& action, const std::string& color) {
        return "select(action." + action +
               ", rank-bit[sum[o in obj](int(state.shown[o] == " + color + "))], 0)";
    };
    EXPECT_NE(
        step_text(program).find("next.rank = rank-cases[rank-case[bit_or(" + term("reds", "0") +
                                ", " + term("greens", "1") + ")], state.rank]"),
        std::string::npos)
        << step_text(program);
    // 2 before 0 before 3, and no case for 1.
    EXPECT_EQ(values_of(program, "rank-case"),
              (std::vector<std::int64_t>{3, 1, 3, 1, 0, 0, 0, 0, 2, 1, 2, 1, 0, 0, 0, 0}));
    EXPECT_EQ(values_of(program, "rank-cases"),
              (std::vector<std::int64_t>{1, 2, 2, 0, 0, 1, 2, 1, 0, 0, 1, 2}));
}

TEST(LookUpCases, PassesOverWhatNoCountReaches) {
    EXPECT_EQ(values_of(after(chain({met("7"), met("0"), met("3")})), "rank-case"),
              (std::vector<std::int64_t>{3, 1, 3, 1, 3, 1, 3, 1, 2, 1, 2, 1, 2, 1, 2, 1}));
}

// Few cases, other counts or other values.
TEST(LookUpCases, LeavesOthers) {
    const std::string other =
        "((reds ^ " + count_of("red") + " == 1) | (greens ^ " + count_of("blue") + " == 1))";
    for (const std::string& cpf :
         {chain({met("2"), met("0")}), chain({met("2"), other, met("0")}),
          "if " + met("2") + " then UP(rank) else if " + met("1") + " then DOWN(rank) else if " +
              met("0") + " then TURNED(other) else rank"})
        EXPECT_EQ(step_text(after(cpf)).find("rank-case["), std::string::npos) << cpf;
}

}  // namespace
}  // namespace rddlc
