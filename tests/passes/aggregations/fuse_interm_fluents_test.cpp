#include "passes/aggregations/fuse_interm_fluents.hpp"

#include "texts.hpp"

namespace rddlc {
namespace {

// The step afterwards.
std::string fused(const std::string& interm_fluents, const std::string& cpfs,
                  const std::string& reward = "0") {
    const ir::Program program =
        of_moderate_values({.pvariables = "x : { state-fluent, real, default = 1.0 };\n"
                                          "y : { state-fluent, real, default = 1.0 };\n"
                                          "v(obj) : { state-fluent, real, default = 1.0 };\n"
                                          "n(obj) : { state-fluent, int, default = 1 };\n" +
                                          interm_fluents,
                            .cpfs = cpfs + "y' = y; n'(?o) = n(?o);",
                            .reward = reward});
    passes::Report report;
    return step_text(valid(passes::fuse_interm_fluents(program, report)));
}

TEST(FuseIntermFluents, ComputesThemWhereTheyAreRead) {
    const std::string step =
        fused("t(obj) : { interm-fluent, real };",
              "t(?o) = v(?o) * v(?o) + 1; x' = sqrt[sum_{?o : obj} t(?o)]; v'(?o) = v(?o);");
    EXPECT_NE(step.find("next.x = sqrt(sum[o in obj](state.v[o] * state.v[o] + 1.0))"),
              std::string::npos)
        << step;
}

TEST(FuseIntermFluents, PutsTheReadersIndicesInPlace) {
    const std::string step =
        fused("t(obj, obj) : { interm-fluent, real };",
              "t(?o, ?u) = v(?o) * n(?u); x' = 0.0; v'(?u) = sum_{?w : obj} t(?w, ?u);");
    EXPECT_NE(step.find("next.v[u] = sum[w in obj](state.v[w] * real(state.n[u]))"),
              std::string::npos)
        << step;
}

TEST(FuseIntermFluents, RepeatsOnlyWhatIsCheap) {
    const std::string step =
        fused("same : { interm-fluent, real }; long : { interm-fluent, real };",
              "same = y; long = sqrt[y * y + 1]; x' = same + long; v'(?o) = same * long;");
    EXPECT_NE(step.find("scratch.long = sqrt("), std::string::npos) << step;
    EXPECT_NE(step.find("next.x = state.y + scratch.long"), std::string::npos) << step;
    EXPECT_NE(step.find("next.v[o] = state.y * scratch.long"), std::string::npos) << step;
}

// share_subexpressions gives it a name there.
TEST(FuseIntermFluents, RepeatsWhatOneDefinitionReadsByTheSameIndices) {
    const std::string step =
        fused("t(obj) : { interm-fluent, real }; u(obj) : { interm-fluent, real };",
              "t(?o) = exp[v(?o)]; u(?o) = exp[v(?o) + 1]; x' = sum_{?o : obj} u(?o);"
              "v'(?o) = t(?o) * t(?o) + u(?o) * u(?o);");
    EXPECT_NE(
        step.find("next.v[o] = exp(state.v[o]) * exp(state.v[o]) + scratch.u[o] * scratch.u[o]"),
        std::string::npos)
        << step;
}

// Else the expression of a chain would double with each link.
TEST(FuseIntermFluents, RepeatsNothingLong) {
    std::string fluents, cpfs = "t0(?o) = v(?o);";
    for (int i = 0; i < 60; ++i)
        fluents += "t" + std::to_string(i) + "(obj) : { interm-fluent, real };";
    for (int i = 1; i < 60; ++i) {
        const std::string last = "t" + std::to_string(i - 1) + "(?o)";
        cpfs += "t" + std::to_string(i) + "(?o) = " + last + " * (1.0 - " + last + ") * 3.7;";
    }
    const std::string step = fused(fluents, cpfs + "x' = 0.0; v'(?o) = t59(?o);");
    EXPECT_NE(step.find("scratch.t"), std::string::npos);
    EXPECT_LT(step.size(), 60'000u);
}

TEST(FuseIntermFluents, LeavesWhatALoopWouldRepeat) {
    const std::string step =
        fused("s : { interm-fluent, real };",
              "s = sum_{?u : obj} v(?u) * v(?u); x' = 0.0; v'(?o) = v(?o) / s;");
    EXPECT_NE(step.find("next.v[o] = state.v[o] / scratch.s"), std::string::npos) << step;
}

TEST(FuseIntermFluents, LeavesTheNameOfASingleValue) {
    const std::string step = fused("s : { interm-fluent, real };",
                                   "s = sqrt[sum_{?u : obj} v(?u)]; x' = s; v'(?o) = v(?o);");
    EXPECT_NE(step.find("next.x = scratch.s"), std::string::npos) << step;
}

TEST(FuseIntermFluents, LeavesWhatMayFault) {
    const std::string step =
        fused("risky : { interm-fluent, bool };",
              "risky = Bernoulli(x); x' = if (y > 0) then 1.0 * risky else 0.0; v'(?o) = v(?o);");
    EXPECT_NE(step.find("real(scratch.risky)"), std::string::npos) << step;
}

TEST(FuseIntermFluents, KeepsThePlacesOfDraws) {
    const std::string step = fused(
        "drawn(obj) : { interm-fluent, real }; other(obj) : { interm-fluent, real };"
        "best : { interm-fluent, obj };",
        "drawn(?o) = Normal(0, 1); other(?o) = Normal(0, 1); best = argmax_{?o : obj} v(?o);"
        "x' = other(best); v'(?u) = v(?u) + drawn(?u);");
    EXPECT_NE(step.find("next.v[u] = state.v[u] + sample normal@0[u](0.0, 1.0)"), std::string::npos)
        << step;
    EXPECT_NE(step.find("scratch.other["), std::string::npos) << "the compiler knows all places";
}

TEST(FuseIntermFluents, BindsNoVariableInsideItself) {
    const std::string step =
        fused("all(obj) : { interm-fluent, real };",
              "all(?u) = sum_{?o : obj} v(?o) * n(?u); x' = 0.0; v'(?o) = all(?o);");
    EXPECT_NE(step.find("next.v[o] = scratch.all[o]"), std::string::npos) << step;
}

TEST(FuseIntermFluents, LeavesWhatFunctionsTake) {
    const std::string step =
        fused("t(obj) : { interm-fluent, real };",
              "t(?o) = v(?o); x' = $f[](t(_)) + sum_{?o : obj} t(?o); v'(?o) = v(?o);");
    EXPECT_NE(step.find("sum[o in obj](scratch.t[o])"), std::string::npos) << step;
}

}  // namespace
}  // namespace rddlc
