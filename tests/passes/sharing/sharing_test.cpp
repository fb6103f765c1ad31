#include "passes/sharing/share_subexpressions.hpp"
#include "problem.hpp"

#include <gtest/gtest.h>

namespace rddlc {
namespace {

ir::Program shared(ir::Program program) {
    passes::Report report;
    program = passes::share_subexpressions(std::move(program), report);
    for (const std::string& complaint : ir::verify(program)) ADD_FAILURE() << complaint;
    return program;
}

Problem one_cpf(const std::string& cpf) {
    return {.pvariables =
                "W(obj, obj) : { non-fluent, real, default = 1.0 };\n"
                "v(obj) : { state-fluent, real, default = 0.0 };\n"
                "p(obj) : { state-fluent, bool, default = false };\n"
                "s : { interm-fluent, real };\n"
                "t(obj) : { interm-fluent, real };",
            .cpfs = "v'(?o) = v(?o);\np'(?o) = p(?o);\n" + cpf,
            .non_fluents = "W(b1, b1) = 2.0;"};
}

// The lines of the step from `from` on.
std::string tail(const ir::Program& program, const std::string& from) {
    const std::string text = step_text(program);
    const std::size_t begin = text.find(from);
    const std::size_t end = text.find("for o in obj\n    next.", begin + 1);
    return text.substr(begin, end - begin);
}

TEST(ShareSubexpressions, NamesWhatIsUsedTwice) {
    const ir::Program before =
        grounded(one_cpf("t(?o) = v(?o); s = sqrt[sum_{?u : obj} v(?u)] + 1 / sqrt[sum_{?u : obj} "
                         "v(?u)];"));
    EXPECT_EQ(tail(before, "scratch.s"),
              "scratch.s = sqrt(sum[u in obj](state.v[u])) + "
              "1.0 / sqrt(sum[u in obj](state.v[u]))\n"
              "for o in obj\n    scratch.t[o] = state.v[o]\n");
    EXPECT_EQ(tail(shared(before), "let"),
              "let %0 = sqrt(sum[u in obj](state.v[u]))\n"
              "scratch.s = %0 + 1.0 / %0\n"
              "for o in obj\n    scratch.t[o] = state.v[o]\n");
}

TEST(ShareSubexpressions, HoistsWhatALoopDoesNotChange) {
    const ir::Program before =
        grounded(one_cpf("s = 0; t(?o) = v(?o) / sum_{?u : obj} v(?u) * v(?u);"));
    EXPECT_EQ(tail(before, "for o in obj\n    scratch.t"),
              "for o in obj\n"
              "    scratch.t[o] = state.v[o] / sum[u in obj](state.v[u] * state.v[u])\n");
    EXPECT_EQ(tail(shared(before), "let"),
              "let %0 = sum[u in obj](state.v[u] * state.v[u])\n"
              "for o in obj\n"
              "    scratch.t[o] = state.v[o] / %0\n");
}

TEST(ShareSubexpressions, HoistsOutOfAggregations) {
    const ir::Program after = shared(
        grounded(one_cpf("t(?o) = 0; s = sum_{?o : obj} [v(?o) * exists_{?u : obj} p(?u)];")));
    EXPECT_EQ(tail(after, "let"),
              "let %0 = real(exists[u in obj](state.p[u]))\n"
              "scratch.s = sum[o in obj](state.v[o] * %0)\n"
              "for o in obj\n    scratch.t[o] = 0.0\n");
}

TEST(ShareSubexpressions, StaysInTheLoopThatBindsItsVariables) {
    const ir::Program after = shared(
        grounded(one_cpf("s = 0; t(?o) = [sum_{?u : obj} W(?o, ?u) * v(?u)] * [sum_{?u : obj} "
                         "W(?o, ?u) * v(?u)];")));
    EXPECT_EQ(tail(after, "for o in obj\n    let"),
              "for o in obj\n"
              "    let %0 = sum[u in obj](W[o, u] * state.v[u])\n"
              "    scratch.t[o] = %0 * %0\n");
}

TEST(ShareSubexpressions, RepeatsTrivialExpressions) {
    const ir::Program after =
        shared(grounded(one_cpf("s = 0; t(?o) = (v(?o) + 1) * (v(?o) + 1);")));
    EXPECT_EQ(step_text(after).find("let"), std::string::npos);
}

TEST(ShareSubexpressions, LeavesLazyBranchesAlone) {
    const std::string cpf =
        "s = 0; t(?o) = if (p(?o)) then ln[sum_{?u : obj} v(?u)] * ln[sum_{?u : obj} v(?u)] else "
        "Uniform(0, sum_{?u : obj} v(?u));";
    const ir::Program before = grounded(one_cpf(cpf));
    EXPECT_EQ(step_text(shared(before)), step_text(before));
}

// An exists over three objects costs less than nine evaluations of something, and more than three.
TEST(ShareSubexpressions, HoistsOutOfLazyBranchesWhatCostsLessThanTheLoop) {
    const auto with_loop_over = [](const std::string& objects, const std::string& variables,
                                   const std::string& invariant) {
        return step_text(shared(
            grounded({.pvariables = "p(obj) : { state-fluent, bool, default = false };\n"
                                    "v(obj) : { state-fluent, real, default = 0.0 };\n"
                                    "k(obj) : { state-fluent, int, default = 0 };\n"
                                    "t(" +
                                    objects + ") : { interm-fluent, bool };",
                      .cpfs = "p'(?o) = p(?o);\nv'(?o) = v(?o);\nk'(?o) = k(?o);\nt(" + variables +
                              ") = if (p(?o)) then ln[v(?o)] > 0 else " + invariant + ";"})));
    };
    const std::string any = "(exists_{?u : obj} p(?u))";
    const std::string let = "let %0 = exists[u in obj](state.p[u])";
    EXPECT_NE(with_loop_over("obj, obj", "?o, ?w", any).find(let), std::string::npos);
    EXPECT_EQ(with_loop_over("obj", "?o", any).find(let), std::string::npos);
    const std::string may_fault = "(exists_{?u : obj} (div[4, k(?u)] > 2))";
    EXPECT_EQ(with_loop_over("obj, obj", "?o, ?w", may_fault).find("let %0 = exists"),
              std::string::npos);
}

TEST(ShareSubexpressions, SharesWhatACaseDistinctionNeedsInAnyCase) {
    const ir::Program after = shared(grounded(
        one_cpf("s = 0; t(?o) = if ((sum_{?u : obj} v(?u)) > 1) then 1 / sum_{?u : obj} v(?u) "
                "else 0;")));
    EXPECT_EQ(tail(after, "let"),
              "let %0 = sum[u in obj](state.v[u])\n"
              "let %1 = select(%0 > 1.0, 1.0 / %0, 0.0)\n"
              "for o in obj\n"
              "    scratch.t[o] = %1\n");
}

TEST(ShareSubexpressions, NeverSharesDifferentDraws) {
    const ir::Program before =
        grounded(one_cpf("s = Normal(0, 1) + Normal(0, 1); t(?o) = sum_{?u : obj} Normal(0, 1);"));
    EXPECT_EQ(step_text(shared(before)), step_text(before));
}

TEST(ShareSubexpressions, DrawsOnceWhatASwitchAsksSeveralTimes) {
    const ir::Program after = shared(grounded(
        {.pvariables = "hue(obj) : { state-fluent, color, default = @red };\n"
                       "v(obj) : { state-fluent, real, default = 0.5 };\n"
                       "s : { interm-fluent, real };",
         .cpfs = "hue'(?o) = hue(?o);\nv'(?o) = v(?o);\n"
                 "s = switch (hue(Discrete_{?o : obj} v(?o))) { case @red : 1.0, case @green : "
                 "2.0, case @blue : 3.0 };"}));
    EXPECT_EQ(tail(after, "let"),
              "let %0 = state.hue[sample discrete@0[0][o in obj](state.v[o])]\n"
              "scratch.s = select(%0 == 0, 1.0, select(%0 == 1, 2.0, 3.0))\n");
}

TEST(ShareSubexpressions, WorksInRewardAndConditions) {
    Problem problem = one_cpf("s = 0; t(?o) = 0;");
    problem.reward = "[sum_{?u : obj} v(?u)] / [sum_{?u : obj} v(?u)]";
    problem.blocks = "termination { forall_{?o : obj} [p(?o) ^ exists_{?u : obj} [v(?u) > 1]]; };";
    const std::string text = ir::print(shared(grounded(problem)));
    EXPECT_NE(text.find("reward\n"
                        "    let %0 = sum[u in obj](state.v[u])\n"
                        "    = %0 / %0\n"
                        "termination 0\n"
                        "    let %1 = exists[u in obj](state.v[u] > 1.0)\n"
                        "    = forall[o in obj](state.p[o] && %1)\n"),
              std::string::npos)
        << text;
}

}  // namespace
}  // namespace rddlc
