#include "passes/sharing/share_across_definitions.hpp"

#include "texts.hpp"

namespace rddlc {
namespace {

struct Shared {
    std::string step, reward;
};
Shared shared(const std::string& cpfs, const std::string& reward = "0") {
    const ir::Program program =
        grounded({.pvariables = "x : { state-fluent, real, default = 1.0 };\n"
                                "y : { state-fluent, real, default = 1.0 };\n"
                                "p : { state-fluent, bool, default = true };\n"
                                "v(obj) : { state-fluent, real, default = 1.0 };\n"
                                "w(obj) : { state-fluent, real, default = 1.0 };\n"
                                "s : { interm-fluent, real };",
                  .cpfs = "p' = p;" + cpfs,
                  .reward = reward});
    passes::Report report;
    const ir::Program after = valid(passes::share_across_definitions(program, report));
    const std::string text = ir::print(after);
    const std::size_t begin = text.find("\nreward");
    return {step_text(after), text.substr(begin + 1, text.find("\n\n", begin) - begin)};
}

TEST(ShareAcrossDefinitions, ComputesOnceWhatTwoCpfsNeed) {
    const Shared result =
        shared("s = 0; x' = x + cos[y]; y' = y + sqrt[1 + cos[y]]; v'(?o) = v(?o); w'(?o) = w(?o);",
               "cos[y]");
    EXPECT_NE(result.step.find("scratch.cos-y = cos(state.y)\n"
                               "next.x = state.x + scratch.cos-y\n"
                               "next.y = state.y + sqrt(1.0 + scratch.cos-y)\n"),
              std::string::npos)
        << result.step;
    EXPECT_EQ(result.reward, "reward = scratch.cos-y\n");
}

TEST(ShareAcrossDefinitions, FillsATableOfTheVariables) {
    const Shared result =
        shared("s = 0; x' = x; y' = y; v'(?o) = exp[w(?o)]; w'(?o) = 1 + exp[w(?o)];");
    EXPECT_NE(result.step.find("for o in obj\n"
                               "    scratch.exp-w[o] = exp(state.w[o])\n"
                               "for o in obj\n"
                               "    next.v[o] = scratch.exp-w[o]\n"
                               "for o in obj\n"
                               "    next.w[o] = 1.0 + scratch.exp-w[o]\n"),
              std::string::npos)
        << result.step;
}

TEST(ShareAcrossDefinitions, LooksIntoBranches) {
    const Shared result = shared(
        "s = 0; x' = if (p) then sin[y] else x; y' = if (p) then y else sin[y];"
        "v'(?o) = v(?o); w'(?o) = w(?o);");
    EXPECT_NE(result.step.find("scratch.sin-y = sin(state.y)\n"), std::string::npos) << result.step;
}

// Two CPFs that jump over a sine compute it behind their jumps.
TEST(ShareAcrossDefinitions, LeavesWhatWaitsForAChoice) {
    const auto shares = [](ir::Evaluated evaluated) {
        ir::Program program = grounded(
            {.pvariables = "x : { state-fluent, real, default = 1.0 };\n"
                           "y : { state-fluent, real, default = 1.0 };\n"
                           "a : { action-fluent, bool, default = false };",
             .cpfs = "x' = if (a) then sin[y] else x; y' = if (a) then y + sin[y] else y;"});
        for (ir::Node& node : program.nodes)
            if (auto* select = std::get_if<ir::Select>(&node.form)) select->evaluated = evaluated;
        passes::Report report;
        return step_text(valid(passes::share_across_definitions(program, report)))
                   .find("scratch.sin-y = ") != std::string::npos;
    };
    EXPECT_TRUE(shares(ir::Evaluated::Branch));
    EXPECT_FALSE(shares(ir::Evaluated::Jump));
}

TEST(ShareAcrossDefinitions, LeavesWhatIsCheapOrNeededOnce) {
    const Shared result =
        shared("s = 0; x' = x * y + sin[y] * sin[y]; y' = x * y; v'(?o) = v(?o); w'(?o) = w(?o);");
    EXPECT_EQ(result.step.find("scratch.sin"), std::string::npos) << result.step;
    EXPECT_NE(result.step.find("select(state.y == 0.0, state.y, state.x * state.y)"),
              std::string::npos)
        << result.step;
}

TEST(ShareAcrossDefinitions, LeavesFaults) {
    const Shared result =
        shared("s = 0; x' = lngamma[y]; y' = 1 + lngamma[y]; v'(?o) = v(?o); w'(?o) = w(?o);");
    EXPECT_EQ(result.step.find("scratch.lngamma"), std::string::npos) << result.step;
}

TEST(ShareAcrossDefinitions, WaitsForWhatItReads) {
    const Shared result =
        shared("s = x + y; x' = exp[s]; y' = 1 / exp[s]; v'(?o) = v(?o); w'(?o) = w(?o);");
    EXPECT_NE(result.step.find("scratch.exp-s = exp(scratch.s)\n"
                               "next.x = scratch.exp-s\n"),
              std::string::npos)
        << result.step;
}

}  // namespace
}  // namespace rddlc
