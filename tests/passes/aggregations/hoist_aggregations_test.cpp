#include "passes/aggregations/hoist_aggregations.hpp"

#include "passes/aggregations/factor_aggregations.hpp"
#include "problem.hpp"

#include <gtest/gtest.h>

namespace rddlc {
namespace {

using Pass = ir::Program (*)(ir::Program, passes::Report&);

ir::Program after(Pass pass, ir::Program program) {
    passes::Report report;
    program = pass(std::move(program), report);
    for (const std::string& complaint : ir::verify(program)) ADD_FAILURE() << complaint;
    return program;
}

Problem shop(const std::string& cpf_of_sold, const std::string& reward = "0") {
    return {.pvariables =
                "buys(pair, color) : { state-fluent, bool, default = false };\n"
                "by(obj, color) : { state-fluent, bool, default = false };\n"
                "price(color) : { state-fluent, real, default = 1.0 };\n"
                "n : { state-fluent, int, default = 0 };\n"
                "sold(obj) : { state-fluent, int, default = 0 };",
            .cpfs = "sold'(?p) = " + cpf_of_sold +
                    ";\nbuys'(?c, ?i) = buys(?c, ?i);\nby'(?p, ?i) = by(?p, ?i);\n"
                    "price'(?i) = price(?i);\nn' = n;",
            .reward = reward};
}

// The lines that compute sold: the last ones of the step.
std::string until_sold(const ir::Program& program) {
    const std::string text = step_text(program);
    const std::string before = "next.price[i] = state.price[i]\n";
    return text.substr(text.find(before) + before.size());
}

TEST(FactorAggregations, TakesOutWhatAnInnerVariableDoesNotChange) {
    const ir::Program before =
        grounded(shop("sum_{?c : pair, ?i : color} [buys(?c, ?i) ^ by(?p, ?i)]"));
    EXPECT_EQ(until_sold(before),
              "for p in obj\n"
              "    next.sold[p] = "
              "sum[c in pair](sum[i in color](int(state.buys[c, i] && state.by[p, i])))\n");
    EXPECT_EQ(
        until_sold(after(passes::factor_aggregations, before)),
        "for p in obj\n"
        "    next.sold[p] = "
        "sum[i in color](select(state.by[p, i], sum[c in pair](int(state.buys[c, i])), 0))\n");
}

TEST(FactorAggregations, KnowsQuantifiers) {
    EXPECT_EQ(until_sold(after(passes::factor_aggregations,
                               grounded(shop("exists_{?c : pair, ?i : color} [buys(?c, ?i) ^ "
                                             "by(?p, ?i)]")))),
              "for p in obj\n"
              "    next.sold[p] = int(exists[i in color](state.by[p, i] && "
              "exists[c in pair](state.buys[c, i])))\n");
    EXPECT_EQ(until_sold(after(passes::factor_aggregations,
                               grounded(shop("forall_{?c : pair, ?i : color} [buys(?c, ?i) | "
                                             "by(?p, ?i)]")))),
              "for p in obj\n"
              "    next.sold[p] = int(forall[i in color](state.by[p, i] || "
              "forall[c in pair](state.buys[c, i])))\n");
}

TEST(FactorAggregations, LeavesWhatDoesNotGetSimpler) {
    const ir::Program before =
        grounded(shop("sum_{?i : color} [by(?p, ?i) * (if (by(?p, ?i)) then 2 else n)]"));
    EXPECT_EQ(until_sold(after(passes::factor_aggregations, before)), until_sold(before));
}

TEST(FactorAggregations, TakesOutOfAllVariables) {
    const ir::Program before =
        grounded(shop("sum_{?c : pair, ?i : color} [buys(?c, ?i) ^ by(?p, @red)]"));
    EXPECT_EQ(until_sold(after(passes::factor_aggregations, before)),
              "for p in obj\n"
              "    next.sold[p] = select(state.by[p, 0], "
              "sum[c in pair](sum[i in color](int(state.buys[c, i]))), 0)\n");
}

TEST(HoistAggregations, FillsTablesBeforeTheLoops) {
    const ir::Program before = grounded(
        shop("sum_{?i : color} [by(?p, ?i) ^ (sum_{?c : pair} [buys(?c, ?i) * exp[price(?i)]]) > "
             "n]"));
    EXPECT_EQ(until_sold(after(passes::hoist_aggregations, before)),
              "for i in color\n"
              "    scratch.sold-by-color[i] = "
              "sum[c in pair](real(state.buys[c, i]) * exp(state.price[i])) > real(state.n)\n"
              "for p in obj\n"
              "    next.sold[p] = "
              "sum[i in color](int(state.by[p, i] && scratch.sold-by-color[i]))\n");
}

TEST(HoistAggregations, UsesTablesOfEarlierStatements) {
    const std::string sum = "(sum_{?c : pair} [buys(?c, ?i) * exp[price(?i)]])";
    const ir::Program program =
        after(passes::hoist_aggregations,
              grounded(shop("sum_{?i : color} [1.5 * by(?p, ?i) < " + sum + "]",
                            "sum_{?i : color} [price(?i) * " + sum + "]")));
    EXPECT_EQ(ir::print(program, program.reward.value),
              "sum[i in color](state.price[i] * scratch.sold-by-color[i])");
}

// OWNER chooses one of two pairs for each of twenty objects.
std::string step_with_owners(const std::string& cpf_of_v, Pass pass) {
    std::string owners = "RISK(b1, @red) = 0.25;";
    for (int k = 1; k <= 20; ++k)
        owners += " OWNER(b" + std::to_string(k) + ") = @a" + std::to_string(1 + k % 2) + ";";
    const Problem problem = {
        .pvariables =
            "OWNER(obj) : { non-fluent, pair };\n"
            "RISK(obj, color) : { non-fluent, real, default = 0.5 };\n"
            "at(pair, obj, color) : { state-fluent, bool, default = false };\n"
            "v(obj) : { state-fluent, real, default = 0.0 };",
        .cpfs = "v'(?t) = " + cpf_of_v + ";\nat'(?o, ?x, ?y) = at(?o, ?x, ?y);",
        .non_fluents = owners};
    const ir::Program before = grounded_with_many(problem);
    return step_text(pass ? after(pass, before) : before);
}

TEST(HoistAggregations, FillsATableFromWhichAConstantChooses) {
    EXPECT_NE(step_with_owners("sum_{?x : obj, ?y : color} [at(OWNER(?t), ?x, ?y) * RISK(?x, ?y)]",
                               passes::hoist_aggregations)
                  .find("for pair in pair\n"
                        "    scratch.v-by-pair[pair] = sum[x in obj](sum[y in color]("
                        "real(state.at[pair, x, y]) * RISK[x, y]))\n"
                        "for t in obj\n"
                        "    next.v[t] = scratch.v-by-pair[OWNER[t]]\n"),
              std::string::npos);
}

TEST(HoistAggregations, LeavesSumsThatAlsoNeedTheObjectItself) {
    const std::string sum = "sum_{?x : obj, ?y : color} [at(OWNER(?t), ?x, ?y) * RISK(?t, ?y)]";
    EXPECT_EQ(step_with_owners(sum, passes::hoist_aggregations), step_with_owners(sum, nullptr));
}

TEST(HoistAggregations, FillsATableOfBoolsFromWhichAConstantChooses) {
    EXPECT_NE(step_with_owners("sum_{?x : obj} [exists_{?y : color} [at(OWNER(?t), ?x, ?y) ^ "
                               "RISK(?t, @red) < 0.4 ^ RISK(?x, ?y) < 0.4]]",
                               passes::hoist_aggregations)
                  .find("for x in obj\n"
                        "    for pair in pair\n"
                        "        scratch.v-by-obj-pair[x, pair] = exists[y in color]("
                        "state.at[pair, x, y] && RISK[x, y] < 0.4)\n"
                        "for t in obj\n"
                        "    next.v[t] = real(sum[x in obj](int("
                        "RISK[t, 0] < 0.4 && scratch.v-by-obj-pair[x, OWNER[t]])))\n"),
              std::string::npos);
}

TEST(HoistAggregations, LeavesAnExistsThatLoopsAloneRepeat) {
    const std::string exists = "exists_{?x : obj} [at(OWNER(?t), ?x, @red) ^ RISK(?x, @red) < 0.4]";
    EXPECT_EQ(step_with_owners(exists, passes::hoist_aggregations),
              step_with_owners(exists, nullptr));
}

TEST(HoistAggregations, LetsTheBoolsOfALoopLieInRows) {
    EXPECT_NE(
        step_with_owners("sum_{?x : obj, ?z : obj} [RISK(?z, @red) < 0.4 ^ "
                         "(exists_{?y : color} [at(OWNER(?x), ?x, ?y) ^ at(OWNER(?t), ?t, ?y)])]",
                         passes::hoist_aggregations)
            .find("for x in obj\n"
                  "    for t in obj\n"
                  "        scratch.v-by-obj-obj[x, t] = exists[y in color]("
                  "state.at[OWNER[x], x, y] && state.at[OWNER[t], t, y])\n"),
        std::string::npos);
}

TEST(HoistAggregations, LeavesWhatMayFault) {
    const ir::Program before = grounded(
        shop("sum_{?i : color} [by(?p, ?i) ^ (exists_{?c : pair} [Bernoulli(price(?i))])]"));
    EXPECT_EQ(until_sold(after(passes::hoist_aggregations, before)), until_sold(before));
}

}  // namespace
}  // namespace rddlc
