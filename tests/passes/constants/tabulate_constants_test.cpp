#include "passes/constants/tabulate_constants.hpp"

#include "passes/constants/tabulate_constant_fluents.hpp"
#include "texts.hpp"

namespace rddlc {
namespace {

TEST(TabulateConstants, ComputesWhatTablesAndVariablesDecide) {
    ir::Program program = grounded(with_tables("sum_{?o : obj} [(W(?o) - SAME(?o)) / 2 * v(?o)]"));
    EXPECT_EQ(value_of_x(program), "sum[o in obj]((W[o] - SAME[o]) / 2.0 * state.v[o])");
    passes::Report report;
    program = valid(passes::tabulate_constants(std::move(program), report));
    EXPECT_EQ(value_of_x(program), "sum[o in obj](x-table[o] * state.v[o])");
    EXPECT_EQ(table_text(program, "x-table"), "x-table[obj]: real = {-0.25 1.25 -0.25}");
    EXPECT_EQ(report["tables computed"], 1);
}

TEST(TabulateConstants, ComputesAggregationsOverTables) {
    ir::Program program =
        grounded(with_tables("sum_{?o : obj} [v(?o) * sum_{?u : obj} (W(?u) > W(?o))]"));
    passes::Report report;
    program = valid(passes::tabulate_constants(std::move(program), report));
    EXPECT_EQ(value_of_x(program), "sum[o in obj](state.v[o] * x-table[o])");
    EXPECT_EQ(table_text(program, "x-table"), "x-table[obj]: real = {1.0 0.0 1.0}");
}

TEST(TabulateConstants, HasADimensionForEachVariable) {
    ir::Program program =
        grounded(with_tables("sum_{?o : obj, ?u : obj} [(W(?u) > 1 | NONE(?u, ?o)) ^ p(?o)]"));
    passes::Report report;
    program = valid(passes::tabulate_constants(std::move(program), report));
    EXPECT_EQ(value_of_x(program),
              "real(sum[o in obj](sum[u in obj](int(x-table[u, o] && state.p[o]))))");
}

TEST(TabulateConstants, MakesATableOfEqualElementsAConstant) {
    const Texts x = of_x("sum_{?o : obj} [v(?o) * (W(?o) * 0 + 2)]", passes::tabulate_constants);
    EXPECT_EQ(x.before, "sum[o in obj](state.v[o] * (W[o] * 0.0 + 2.0))");
    EXPECT_EQ(x.after, "sum[o in obj](state.v[o] * 2.0)");
}

TEST(TabulateConstants, LeavesWhatSavesNothing) {
    const Texts x =
        of_x("sum_{?o : obj, ?u : obj} [v(?o) * W(?o) * (?o == ?u)]", passes::tabulate_constants);
    EXPECT_EQ(x.after, x.before);
}

TEST(TabulateConstants, LeavesFaultsToTheRun) {
    const Texts x = of_x("sum_{?o : obj} [v(?o) * pow[2, E(?o)]]", passes::tabulate_constants);
    EXPECT_EQ(x.before, "sum[o in obj](state.v[o] * real(power@0[o](2, E[o])))");
    EXPECT_EQ(x.after, x.before);
}

Problem with_fluents() {
    Problem problem = with_tables("sum_{?o : obj} [v(?o) * (heavy(?o) ^ near(?o, ?o))] + LIMIT");
    problem.pvariables +=
        "heavy(obj) : { interm-fluent, bool };\nnear(obj, obj) : { interm-fluent, bool };\n"
        "LIMIT : { interm-fluent, int };\nrisky(obj) : { interm-fluent, int };";
    problem.cpfs +=
        "heavy(?o) = W(?o) > LIMIT;\nnear(?o, ?u) = heavy(?o) ^ ?o == ?u;\n"
        "LIMIT = 1 + 1;\nrisky(?o) = pow[2, E(?o)];";
    return problem;
}

TEST(TabulateConstantFluents, MakesTablesOfThem) {
    ir::Program program = grounded(with_fluents());
    EXPECT_NE(step_text(program).find("scratch.near[o, u] = scratch.heavy[o] && o == u"),
              std::string::npos);
    passes::Report report;
    program = valid(passes::tabulate_constant_fluents(std::move(program), report));
    EXPECT_EQ(value_of_x(program),
              "sum[o in obj](state.v[o] * real(heavy[o] && near[o, o]) + 2.0)");
    EXPECT_EQ(table_text(program, "heavy"), "heavy[obj]: bool = {false true false}");
    EXPECT_EQ(table_text(program, "near"),
              "near[obj, obj]: bool = {false false false false true false false false false}");
    EXPECT_EQ(report["interm-fluents made constant"], 3);
}

TEST(TabulateConstantFluents, LeavesFaultsToTheRun) {
    passes::Report report;
    const ir::Program program =
        valid(passes::tabulate_constant_fluents(grounded(with_fluents()), report));
    EXPECT_NE(step_text(program).find("scratch.risky[o] = power@0[o](2, E[o])"), std::string::npos);
}

}  // namespace
}  // namespace rddlc
