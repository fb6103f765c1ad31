#include "passes/sharing/pair_angles.hpp"

#include "texts.hpp"

namespace rddlc {
namespace {

ir::Program grounded_vehicles(const std::string& cpfs, const std::string& reward = "0") {
    return grounded({.pvariables = "x(obj) : { state-fluent, real, default = 0.0 };\n"
                                   "y(obj) : { state-fluent, real, default = 0.0 };\n"
                                   "a(obj) : { state-fluent, real, default = 0.5 };\n"
                                   "b : { state-fluent, real, default = 0.5 };\n"
                                   "on : { state-fluent, bool, default = true };",
                     .cpfs = cpfs + "a'(?o) = a(?o); b' = b; on' = on;",
                     .reward = reward});
}

TEST(PairAngles, FillsTheTablesOfBothInOneLoop) {
    passes::Report report;
    const ir::Program program = valid(passes::pair_angles(
        grounded_vehicles("x'(?o) = x(?o) + cos[a(?o)]; y'(?o) = y(?o) + sin[a(?o)];",
                          "sum_{?o : obj} sin[a(?o)]"),
        report));
    const std::string text = ir::print(program);
    for (const char* const line : {"scratch.sin-a[o] = ", "scratch.cos-a[o] = ",
                                   "next.x[o] = state.x[o] + scratch.cos-a[o]\n",
                                   "next.y[o] = state.y[o] + scratch.sin-a[o]\n"})
        EXPECT_NE(step_text(program).find(line), std::string::npos) << step_text(program);
    EXPECT_EQ(text.find("sin(state.a"), text.rfind("sin(state.a")) << text;
    EXPECT_EQ(report["sines and cosines of one angle computed together"], 1);
    EXPECT_EQ(ir::print(passes::pair_angles(program, report)), ir::print(program));
}

TEST(PairAngles, LeavesWhatIsNoPairInTwoLoops) {
    for (const std::string cpfs : {
             "x'(?o) = cos[a(?o)]; y'(?o) = cos[a(?o)];",                      // no sine
             "x'(?o) = cos[a(?o)]; y'(?o) = sin[a(?o) + b];",                  // another angle
             "x'(?o) = cos[a(?o)] * sin[a(?o)]; y'(?o) = 0;",                  // one CPF
             "x'(?o) = cos[b]; y'(?o) = sin[b];",                              // no loop
             "x'(?o) = cos[a(?o)]; y'(?o) = if (on) then sin[a(?o)] else 0;",  // a branch
         }) {
        passes::Report report;
        const ir::Program program = grounded_vehicles(cpfs);
        EXPECT_EQ(ir::print(passes::pair_angles(program, report)), ir::print(program)) << cpfs;
    }
}

}  // namespace
}  // namespace rddlc
