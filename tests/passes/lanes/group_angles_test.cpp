#include "passes/lanes/group_angles.hpp"

#include "texts.hpp"

namespace rddlc {
namespace {

ir::Program grounded_turns(const std::string& cpf_of_x, const std::string& reward) {
    return grounded(
        {.pvariables = "x : { state-fluent, real, default = 0.5 };\n"
                       "y : { state-fluent, real, default = 0.25 };\n"
                       "on : { state-fluent, bool, default = false };\n"
                       "height(obj) : { state-fluent, real, default = 0.0 };\n"
                       "turn : { action-fluent, real, default = 0.0 };",
         .cpfs = "x' = " + cpf_of_x + "; y' = y; on' = on; height'(?o) = height(?o) + cos[x];",
         .reward = reward});
}

TEST(GroupAngles, FillsAVectorWithThoseThatEveryStepNeeds) {
    passes::Report report;
    const ir::Program program =
        valid(passes::group_angles(grounded_turns("x * sin[y]", "cos[x] - sin[y + turn]"), report));
    const std::string text = step_text(program);
    EXPECT_NE(text.find("fill scratch.angles = together(cos(state.x), sin(state.y), "
                        "sin(state.y + action.turn))"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("state.x * scratch.angles[1]"), std::string::npos) << text;
    EXPECT_NE(text.find("state.height[o] + scratch.angles[0]"), std::string::npos) << text;
    EXPECT_EQ(report["sines and cosines computed together"], 3);
    EXPECT_EQ(ir::print(passes::group_angles(program, report)), ir::print(program));
}

// The sine is one of the same call, whose angles are known before it.
TEST(GroupAngles, LeavesAnglesOfAngles) {
    passes::Report report;
    const std::string text = step_text(valid(passes::group_angles(
        grounded_turns("cos[sin[x]] * sin[x]", "cos[y] - sin[y + turn]"), report)));
    EXPECT_NE(
        text.find("together(cos(state.x), sin(state.x), cos(state.y), sin(state.y + action.turn))"),
        std::string::npos)
        << text;
    EXPECT_NE(text.find("cos(scratch.angles[1]) * scratch.angles[1]"), std::string::npos) << text;
}

TEST(GroupAngles, LeavesTooFewAngles) {
    for (const auto& [cpf, reward] : {
             std::pair{"x + sin[x]", "cos[x] - sin[y]"},             // two angles
             std::pair{"if (on) then sin[y] else x", "cos[x + y]"},  // a branch has the third one
             std::pair{"sin[y]", "sum_{?o : obj} cos[height(?o)]"},  // a loop has it
             std::pair{"sin[y]", "cos[x']"},                         // it is known too late
             std::pair{"sin[y]", "if (on | (cos[x + y] > 0)) then 1 else 0"},
         }) {
        passes::Report report;
        const ir::Program program = grounded_turns(cpf, reward);
        EXPECT_EQ(ir::print(passes::group_angles(program, report)), ir::print(program)) << reward;
    }
}

// The engine asks for conditions after the step, so each has a table of its own.
TEST(GroupAngles, FillsATableOfACondition) {
    const auto text_with = [](const std::string& block) {
        passes::Report report;
        const ir::Program program = valid(passes::group_angles(
            grounded({.pvariables = "x : { state-fluent, real, default = 0.5 };\n"
                                    "y : { state-fluent, real, default = 0.0 };",
                      .cpfs = "x' = x; y' = y;",
                      .blocks = block}),
            report));
        EXPECT_EQ(ir::print(passes::group_angles(program, report)), ir::print(program));
        return ir::print(program);
    };
    EXPECT_NE(text_with("termination { cos[x] + cos[x + y] > 1.0; };")
                  .find("termination 0\n"
                        "    fill scratch.angles = together(cos(state.x), cos(state.x + state.y))\n"
                        "    = scratch.angles[0] + scratch.angles[1] > 1.0\n"),
              std::string::npos);
    EXPECT_NE(text_with("state-invariants { sin[x] <= cos[y]; };")
                  .find("together(sin(state.x), cos(state.y))"),
              std::string::npos);
    for (const std::string one : {"cos[x] + sin[x] > 1.0", "cos[x] > 0.5 | cos[y] > 0.5"})
        EXPECT_EQ(text_with("termination { " + one + "; };").find("together"), std::string::npos);
}

}  // namespace
}  // namespace rddlc
