// The text before and after each pass; sharing has a file of its own.
#include "passes/passes.hpp"

#include "ir/print.hpp"
#include "passes/aggregations/hoist_aggregations.hpp"
#include "passes/constants/fold_constant_expressions.hpp"
#include "passes/constants/fold_uniform_tables.hpp"
#include "passes/sharing/remove_unused_buffers.hpp"
#include "texts.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc {
namespace {

TEST(Pipeline, SaysWhatEachPassDoesAndWhy) {
    EXPECT_NE(pipeline_text().find("make_aggregations_sparse (aggregations)\n"
                                   "    aggregations run over the entries of sparse tables\n"
                                   "    after index_directly and hoist_aggregations: "),
              std::string::npos);
    for (const PassDescription& pass : all_passes()) EXPECT_FALSE(pass.because.empty());
}

TEST(Pipeline, RunsWhatEmittingNeedsInAnyCase) {
    std::vector<PassRun> runs;
    optimise(grounded(with_tables("1.0")), {.without = {"count_bits", "choose_evaluation"}}, &runs);
    EXPECT_EQ(std::ranges::count(runs, "count_bits", &PassRun::name), 0);
    EXPECT_EQ(std::ranges::count(runs, "choose_evaluation", &PassRun::name), 1);
}

TEST(Pipeline, KnowsWhetherAPassIsFinished) {
    const ir::Program program = grounded(with_tables("sum_{?o : obj} v(?o) * SAME(?o)"));
    EXPECT_FALSE(is_finished("fold_uniform_tables", program));
    passes::Report report;
    EXPECT_TRUE(is_finished("fold_uniform_tables", passes::fold_uniform_tables(program, report)));
    EXPECT_THROW(is_finished("no_such_pass", program), std::out_of_range);
}

TEST(Pipeline, FinishesEachPass) {
    const ir::Program program = grounded(
        with_tables("x + sum_{?o : obj, ?u : obj} [NONE(?o, ?u) * W(?o) + v(?u) * SAME(?o)]"));
    PassOptions options;
    options.observe = [](const PassRun& run, const ir::Program& made) {
        EXPECT_TRUE(is_finished(run.name, made)) << run.name;
    };
    optimise(program, options);
}

TEST(FoldUniformTables, ReplacesLoadsByTheValue) {
    const Texts x = of_x("sum_{?o : obj} v(?o) * SAME(?o) * W(?o)", passes::fold_uniform_tables);
    EXPECT_EQ(x.before, "sum[o in obj](state.v[o] * SAME[o] * W[o])");
    EXPECT_EQ(x.after, "sum[o in obj](state.v[o] * 1.5 * W[o])");
}

TEST(FoldUniformTables, FoldsWhatFollows) {
    const Texts x = of_x(
        "sum_{?o : obj} [v(?o) + (if (exists_{?u : obj} [NONE(?o, ?u) ^ p(?u)]) "
        "then 1 else 2)]",
        passes::fold_uniform_tables);
    EXPECT_EQ(x.before,
              "sum[o in obj](state.v[o] + "
              "select(exists[u in obj](NONE[o, u] && state.p[u]), 1.0, 2.0))");
    EXPECT_EQ(x.after, "sum[o in obj](state.v[o] + 2.0)");
}

TEST(FoldUniformTables, KeepsTheTableWhereAnIndexDraws) {
    const Texts x = of_x("SAME(Discrete_{?o : obj} v(?o))", passes::fold_uniform_tables);
    EXPECT_EQ(x.before, "SAME[sample discrete@0[0][o in obj](state.v[o])]");
    EXPECT_EQ(x.after, x.before);
}

TEST(FoldConstantExpressions, EvaluatesWhatOnlyTablesDecide) {
    const Texts x = of_x(
        "x + (sum_{?o : obj} W(?o)) * W(argmax_{?o : obj} W(?o)) + sum_{?o : obj} v(?o) * "
        "W(?o)",
        passes::fold_constant_expressions);
    EXPECT_EQ(x.before,
              "state.x + sum[o in obj](W[o]) * W[argmax[o in obj](W[o])] + "
              "sum[o in obj](state.v[o] * W[o])");
    EXPECT_EQ(x.after, "state.x + 24.0 + sum[o in obj](state.v[o] * W[o])");
}

TEST(FoldConstantExpressions, LeavesFaultsToTheRun) {
    const Texts x = of_x("sum_{?o : obj} pow[2, E(?o)]", passes::fold_constant_expressions);
    EXPECT_EQ(x.before, "real(sum[o in obj](power@0[o](2, E[o])))");
    EXPECT_EQ(x.after, x.before);
}

TEST(RemoveUnusedBuffers, DropsTablesThatNobodyReads) {
    ir::Program program = grounded(with_tables("sum_{?o : obj} v(?o) * W(?o)"));
    EXPECT_EQ(names(program, ir::Storage::Constant), "SAME NONE W E");
    passes::Report report;
    program = valid(passes::remove_unused_buffers(std::move(program), report));
    EXPECT_EQ(names(program, ir::Storage::Constant), "W");
    EXPECT_EQ(value_of_x(program), "sum[o in obj](state.v[o] * W[o])");
    EXPECT_EQ(program.fluents.size(), 7u);
    EXPECT_FALSE(program.fluents[0].buffer);
    EXPECT_EQ(program[*program.fluents[2].buffer].name, "W");
}

TEST(RemoveUnusedBuffers, DropsIntermFluentsThatNobodyReads) {
    ir::Program program =
        grounded({.pvariables = "x : { state-fluent, real, default = 1.0 };\n"
                                "used : { interm-fluent, real };\n"
                                "first : { interm-fluent, real };\n"
                                "second : { interm-fluent, real };\n"
                                "drawn : { interm-fluent, real };\n"
                                "risky : { interm-fluent, bool };",
                  .cpfs = "x' = used;\nused = x + 1;\nfirst = x * 2;\nsecond = first * 2;\n"
                          "drawn = Normal(0, 1);\nrisky = Bernoulli(x);"});
    EXPECT_EQ(names(program, ir::Storage::Scratch), "used first second drawn risky");
    passes::Report report;
    program = valid(passes::remove_unused_buffers(std::move(program), report));
    EXPECT_EQ(names(program, ir::Storage::Scratch), "used risky");
    EXPECT_EQ(step_text(program),
              "scratch.risky = sample bernoulli@1[0](state.x)\n"
              "scratch.used = state.x + 1.0\n"
              "next.x = scratch.used\n");
}

// hoist_aggregations puts such a buffer before the first of two CPFs that need it.
TEST(RemoveUnusedBuffers, KeepsTablesOfDefinitionsThatNobodyReads) {
    const std::string sum = "(sum_{?u : obj} [exp[v(?u)] * near(?o, ?u)])";
    ir::Program program =
        grounded({.pvariables = "v(obj) : { state-fluent, real, default = 1.0 };\n"
                                "near(obj, obj) : { state-fluent, bool, default = true };\n"
                                "unread(obj) : { interm-fluent, real };",
                  .cpfs = "unread(?p) = max_{?o : obj} [" + sum +
                          " * v(?p)];\n"
                          "v'(?p) = max_{?o : obj} [" +
                          sum + " - v(?p)];\nnear'(?o, ?u) = near(?o, ?u);"});
    passes::Report report;
    program = valid(passes::hoist_aggregations(std::move(program), report));
    EXPECT_EQ(report["tables filled before loops"], 2);  // one in the other
    EXPECT_EQ(names(program, ir::Storage::Scratch), "unread unread-by-obj unread-by-obj-2");
    program = valid(passes::remove_unused_buffers(std::move(program), report));
    EXPECT_EQ(names(program, ir::Storage::Scratch), "unread-by-obj unread-by-obj-2");
    EXPECT_TRUE(std::ranges::any_of(program.step, [&](const ir::Definition& definition) {
        return program[definition.target].name == "unread-by-obj";
    })) << "a definition is named after what it still fills";
}

TEST(Optimise, RunsAllPasses) {
    const ir::Program program =
        valid(optimise(grounded(with_tables("sum_{?o : obj} [v(?o) * SAME(?o)]"))));
    EXPECT_EQ(names(program, ir::Storage::Constant), "");
}

TEST(Externals, KeepTheTablesThatTheyGet) {
    const ir::Program program =
        valid(optimise(grounded(with_tables("$f[](SAME(_), NONE(_, _)) + $g[](W(_))"))));
    EXPECT_EQ(names(program, ir::Storage::Constant), "SAME NONE W") << "although two are uniform";
    EXPECT_NE(ir::print(program).find("fill scratch.f = $f(SAME, NONE)"), std::string::npos);
}

TEST(Externals, AreNotCalledForWhatNobodyReads) {
    Problem problem = with_tables("1.0");
    problem.pvariables += "unread : { interm-fluent, real };";
    problem.cpfs += "unread = $f[](W(_));";
    const ir::Program program = valid(optimise(grounded(problem)));
    EXPECT_EQ(ir::print(program).find("$f"), std::string::npos) << ir::print(program);
    EXPECT_EQ(names(program, ir::Storage::Constant), "");
}

// The observer gets each run with the program that it left; the last is the result.
TEST(Optimise, TellsWhatEachPassHasMade) {
    std::vector<std::string> told, texts, ran;
    PassOptions options{.without = {"count_bits"}};
    options.observe = [&](const PassRun& run, const ir::Program& made) {
        told.emplace_back(run.name);
        texts.push_back(ir::print(made));
    };
    std::vector<PassRun> runs;
    const ir::Program program = grounded(with_tables("sum_{?o : obj} [v(?o) * SAME(?o)]"));
    const ir::Program last = optimise(program, options, &runs);
    for (const PassRun& run : runs) ran.emplace_back(run.name);
    // The runs of the program for moderate values, which has no advantage here, follow them.
    ASSERT_EQ(told.size(), 2 * ran.size());
    told.resize(ran.size());
    texts.resize(ran.size());
    EXPECT_EQ(told, ran);
    EXPECT_EQ(told.front(), "tabulate_constant_fluents");
    EXPECT_EQ(std::ranges::count(told, "reduce_strength"), 2);
    EXPECT_EQ(std::ranges::count(told, "count_bits"), 0);
    EXPECT_NE(texts.front(), texts.back());
    EXPECT_EQ(texts.back(), ir::print(last));
}

}  // namespace
}  // namespace rddlc
