// How each construct of RDDL is lowered.
#include "problem.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace rddlc {
namespace {

TEST(Lowering, KeepsLoopsOverObjects) {
    const ir::Program program =
        grounded({.pvariables = "W(obj, pair) : { non-fluent, real, default = 0.5 };\n"
                                "m(obj, pair) : { state-fluent, real, default = 1.0 };\n"
                                "total : { interm-fluent, real };",
                  .cpfs = "m'(?o, ?p) = m(?o, ?p) * W(?o, ?p);\n"
                          "total = sum_{?o : obj, ?p : pair} m(?o, ?p);",
                  .reward = "total"});
    EXPECT_EQ(ir::print(program), R"(program d i

types
    obj: b1 b2 b3
    pair: a1 a2
    color: red green blue

constant
    W[obj, pair]: real = 0.5

state
    m[obj, pair]: real = 1.0

scratch
    total: real

next
    m[obj, pair]: real

step
    for o in obj
        for p in pair
            next.m[o, p] = state.m[o, p] * W[o, p]
    scratch.total = sum[o in obj](sum[p in pair](state.m[o, p]))

reward = scratch.total
)");
}

TEST(Lowering, BindsObjectsAndMembersToNumbers) {
    EXPECT_EQ(lowered("q(@blue) + q(green)"), "state.q[2] + state.q[1]");
    EXPECT_EQ(lowered("sum_{?k : color} [if (?k == @green) then q(?k) else 0.0]"),
              "sum[k in color](select(k == 1, state.q[k], 0.0))");
    EXPECT_EQ(lowered("if (c == @green) then 1.0 else 2.0"), "select(state.c == 1, 1.0, 2.0)");
}

TEST(Lowering, FoldsNonFluentsWithoutParameters) {
    EXPECT_EQ(lowered("x + K"), "state.x + 4.0");
    EXPECT_EQ(lowered("n + K * 2"), "real(state.n + 8)");
}

TEST(Lowering, NestsArguments) {
    EXPECT_EQ(lowered("sum_{?o : obj} q(near(?o))"), "sum[o in obj](state.q[state.near[o]])");
    EXPECT_EQ(lowered("v(argmax_{?o : obj} v(?o))"), "state.v[argmax[o in obj](state.v[o])]");
    EXPECT_EQ(lowered("q(near(argmin_{?o : obj} v(?o)))"),
              "state.q[state.near[argmin[o in obj](state.v[o])]]");
    EXPECT_EQ(lowered("q(Discrete_{?k : color} q(?k))"),
              "state.q[sample discrete@0[0][k in color](state.q[k])]");
}

TEST(Lowering, ReadsPrimedFluentsFromTheNextState) {
    const ir::Program program =
        grounded({.pvariables = "x : { state-fluent, real, default = 0.0 };\n"
                                "y : { state-fluent, real, default = 0.0 };\n"
                                "seen : { observ-fluent, real };",
                  .cpfs = "x' = y' + 1;\ny' = x;\nseen = x';",
                  .reward = "x' - x"});
    EXPECT_EQ(step_text(program),
              "next.y = state.x\n"
              "next.x = next.y + 1.0\n"
              "observation.seen = next.x\n");
    EXPECT_TRUE(program.partially_observed());
    EXPECT_EQ(ir::print(program, program.reward.value), "next.x - state.x");
}

TEST(Lowering, MakesSwitchAChainOfLazyChoices) {
    EXPECT_EQ(lowered("switch (c) { case @red : 1.0, case @green : x, case @blue : 3.0 }"),
              "select(state.c == 0, 1.0, select(state.c == 1, state.x, 3.0))");
    EXPECT_EQ(lowered("switch (c) { default : 9.0, case @blue : x }"),
              "select(state.c == 2, state.x, 9.0)");
}

TEST(Lowering, TakesTheArgumentOfDeltas) {
    EXPECT_EQ(lowered("DiracDelta(x + 1)"), "state.x + 1.0");
    EXPECT_EQ(lowered("KronDelta(n)"), "real(state.n)");
}

TEST(Lowering, LowersImplications) {
    EXPECT_EQ(lowered("forall_{?o : obj} [p(?o) => a(?o)]"),
              "real(forall[o in obj](!state.p[o] || action.a[o]))");
    EXPECT_EQ(lowered("forall_{?o : obj} [p(?o) <=> a(?o)]"),
              "real(forall[o in obj](state.p[o] == action.a[o]))");
}

TEST(Lowering, AveragesSums) {
    EXPECT_EQ(lowered("avg_{?o : obj, ?b : pair} [v(?o) * B(?o, ?b)]"),
              "sum[o in obj](sum[b in pair](state.v[o] * real(B[o, b]))) / 6.0");
    EXPECT_EQ(lowered("avg_{?o : obj} p(?o)"), "sum[o in obj](real(state.p[o])) / 3.0");
}

TEST(Lowering, CountsBools) {
    EXPECT_EQ(lowered("sum_{?o : obj} p(?o)"), "real(sum[o in obj](int(state.p[o])))");
    EXPECT_EQ(lowered("max_{?o : obj} p(?o)"), "real(max[o in obj](int(state.p[o])))");
}

TEST(Lowering, NumbersDrawsByTheirScope) {
    const ir::Program program =
        grounded({.pvariables = "m(obj, pair) : { state-fluent, real, default = 1.0 };",
                  .cpfs = "m'(?o, ?b) = Normal(0, 1) + sum_{?u : obj} Uniform(0, m(?u, ?b));"});
    EXPECT_EQ(step_text(program),
              "for o in obj\n"
              "    for b in pair\n"
              "        next.m[o, b] = sample normal@0[o * 2 + b](0.0, 1.0) + "
              "sum[u in obj](sample uniform@1[(o * 2 + b) * 3 + u](0.0, state.m[u, b]))\n");
    ASSERT_EQ(program.sites.size(), 2u);
    EXPECT_EQ(program.sites[0].scope.size(), 2u);
    EXPECT_EQ(program.sites[1].scope.size(), 3u);
    EXPECT_EQ(program.sites[1].what, "Uniform");
}

// "1 has those of 0"
std::string series_of_sites(const std::string& cpf_of_x) {
    const ir::Program program = grounded(usual_problem(cpf_of_x));
    std::string text;
    for (std::size_t site = 0; site < program.sites.size(); ++site) {
        const auto& series = program.sites[site].series;
        if (!series) continue;
        text += (text.empty() ? "" : ", ") + std::to_string(site) + " has those of " +
                std::to_string(series->index);
    }
    return text;
}

TEST(Lowering, GivesBranchesTheSameNumbers) {
    EXPECT_EQ(series_of_sites("if (x > 1) then Normal(x, 1) else Uniform(0, 1)"),
              "1 has those of 0");
    EXPECT_EQ(series_of_sites("if (x > 1) then Normal(x, 1) + Normal(x, 2) else "
                              "if (x > 2) then Uniform(0, 1) else Uniform(0, 2) + Uniform(0, 3)"),
              "2 has those of 0, 3 has those of 0, 4 has those of 1");
    EXPECT_EQ(series_of_sites("switch (c) { case @red : Normal(x, 1), case @green : 0, "
                              "default : Normal(x, 2) }"),
              "1 has those of 0");
    EXPECT_EQ(series_of_sites("sum_{?o : obj} if (p(?o)) then Normal(x, 1) else Normal(x, 2)"),
              "1 has those of 0");
}

TEST(Lowering, GivesDrawsOfOneBranchDifferentNumbers) {
    EXPECT_EQ(series_of_sites("if (Bernoulli(0.5)) then Normal(x, 1) else 0"), "");
    EXPECT_EQ(series_of_sites("if (x > 1) then Normal(x, Uniform(0, 1)) else 0"), "");
    EXPECT_EQ(series_of_sites("(if (x > 1) then Normal(x, 1) else 0) + Normal(x, 2)"), "");
    // Both may be evaluated in the second branch.
    EXPECT_EQ(series_of_sites("if (x > 1) then Normal(x, 1) else "
                              "((if (x > 2) then Normal(x, 2) else 0) + Normal(x, 3))"),
              "1 has those of 0");
    // One of them is drawn for each object: their indices have another meaning.
    EXPECT_EQ(series_of_sites("if (x > 1) then sum_{?o : obj} Normal(x, 1) else Normal(x, 2)"), "");
}

TEST(Lowering, NamesFallibleOperators) {
    const ir::Program program = grounded(usual_problem("pow[n, n] + lngamma[x]"));
    EXPECT_EQ(value_of_x(program), "real(power@0[0](state.n, state.n)) + ln_gamma@1[0](state.x)");
    EXPECT_EQ(program.sites[0].what, "pow");
    EXPECT_EQ(program.sites[1].what, "lngamma");
}

TEST(Lowering, GivesDiscreteItsWeightsInMemberOrder) {
    const ir::Program program =
        grounded({.pvariables = "c : { state-fluent, color, default = @red };",
                  .cpfs = "c' = Discrete(color, @blue : 0.2, @red : 0.5, @green : 0.3);"});
    EXPECT_EQ(step_text(program), "next.c = sample discrete@0[0](0.5, 0.3, 0.2)\n");
}

TEST(Lowering, EvaluatesTheSimpleOperandFirst) {
    // The fallible draw is on the left; the plain fluent on the right decides.
    EXPECT_EQ(lowered("exists_{?o : obj} [Bernoulli(v(?o)) ^ p(?o)]"),
              "real(exists[o in obj](select(state.p[o], sample bernoulli@0[o](state.v[o]), "
              "false)))");
    EXPECT_EQ(lowered("exists_{?o : obj} [[p(?o) ^ a(?o)] ^ Bernoulli(v(?o))]"),
              "real(exists[o in obj](select(state.p[o] && action.a[o], "
              "sample bernoulli@0[o](state.v[o]), false)))");
    EXPECT_EQ(lowered("exists_{?o : obj} [Bernoulli(0.5) ^ p(?o)]"),
              "real(exists[o in obj](sample bernoulli@0[o](0.5) && state.p[o]))");
}

TEST(Lowering, FaultsWhereTheTypesDoNotFit) {
    const ir::Program program = grounded({.pvariables = "n : { state-fluent, int, default = 0 };",
                                          .cpfs = "n' = if (n < 1) then 1 else 2.5;"});
    EXPECT_EQ(step_text(program), "next.n = select(state.n < 1, 1, fault@0[0])\n");
}

TEST(Lowering, KnowsReductionsOverNoObjects) {
    Problem problem{.pvariables =
                        "x : { state-fluent, real, default = 0.0 };\n"
                        "y : { state-fluent, real, default = 0.0 };",
                    .cpfs =
                        "x' = [sum_{?e : nobody} 1.5] + [prod_{?e : nobody} 2.0];\n"
                        "y' = avg_{?e : nobody} 1.5;"};
    std::string text = problem.text();
    text.insert(text.find("color :"), "nobody : { }; ");
    const Grounded result = ground_text(text);
    ASSERT_TRUE(result.program) << result.messages;
    EXPECT_EQ(step_text(*result.program),
              "next.x = 1.0\n"
              "next.y = nan\n");
}

TEST(Lowering, SharesVariablesOfEqualNameAndType) {
    const ir::Program program = grounded(
        usual_problem("[sum_{?o : obj} v(?o)] * [sum_{?o : obj} v(?o)] + sum_{?b : pair} 1.0"));
    EXPECT_EQ(program.variables.size(), 3u);  // o, b, and k of q'
}

TEST(Lowering, NeedsNoLoopOverASingleObject) {
    Problem problem{.pvariables = "v(obj) : { state-fluent, real, default = 1.0 };",
                    .cpfs = "v'(?o) = v(?o) + sum_{?u : obj} v(?u);"};
    std::string text = problem.text();
    text.replace(text.find("b1, b2, b3"), 10, "b1");
    const Grounded result = ground_text(text);
    ASSERT_TRUE(result.program) << result.messages;
    EXPECT_EQ(step_text(*result.program), "next.v[0] = 0.0 + (state.v[0] + state.v[0])\n")
        << "a sum is never -0.0";
}

TEST(Lowering, DescribesFluentsAsDeclared) {
    const ir::Program program = grounded(usual_problem("x"));
    const auto find = [&](const std::string& name) {
        return *std::ranges::find(program.fluents, name, &ir::Fluent::name);
    };
    EXPECT_EQ(find("B").parameter_types, (std::vector<std::uint32_t>{0, 1}));
    EXPECT_EQ(find("c").object_type, 2u);
    EXPECT_EQ(find("c").scalar, ir::Scalar::Int);
    EXPECT_EQ(find("a").role, Role::Action);
    EXPECT_EQ(program[*find("B").buffer].values[1], ir::Value(true));
    EXPECT_EQ(program.horizon, 10);
    EXPECT_EQ(program.max_nondef_actions, std::nullopt);
}

TEST(Lowering, DoesNotGrowWithTheObjects) {
    Problem problem{.pvariables = "v(obj) : { state-fluent, real, default = 1.0 };",
                    .cpfs = "v'(?o) = sum_{?u : obj} v(?u) * v(?o);"};
    const std::size_t small = grounded(problem).nodes.size();
    std::string text = problem.text();
    std::string objects = "b1";
    for (int i = 2; i <= 500; ++i) objects += ", b" + std::to_string(i);
    text.replace(text.find("b1, b2, b3"), 10, objects);
    const Grounded result = ground_text(text);
    ASSERT_TRUE(result.program) << result.messages;
    EXPECT_EQ(result.program->nodes.size(), small);
}

}  // namespace
}  // namespace rddlc
