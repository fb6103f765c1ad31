#include "passes/aggregations/tabulate_counts.hpp"

#include "passes/aggregations/make_aggregations_sparse.hpp"
#include "texts.hpp"

#include <rddl/values/math.hpp>

#include <algorithm>

namespace rddlc {
namespace {

std::string tabulated(const std::string& cpf_of_x) {
    return of_x(cpf_of_x, passes::tabulate_counts).after;
}

TEST(TabulateCounts, ReplacesWhatDependsOnACount) {
    ir::Program program =
        grounded(with_tables("x + 1.0 / (1.0 + exp[0.5 - sum_{?o : obj} p(?o)])"));
    EXPECT_EQ(value_of_x(program),
              "state.x + 1.0 / (1.0 + exp(0.5 - real(sum[o in obj](int(state.p[o])))))");
    passes::Report report;
    program = valid(passes::tabulate_counts(std::move(program), report));
    EXPECT_EQ(value_of_x(program), "state.x + x-by-count[sum[o in obj](int(state.p[o]))]");
    EXPECT_EQ(report["expressions of a count made tables"], 1);

    const ir::Buffer& table = program.buffers.back();
    ASSERT_EQ(table.shape, std::vector<std::int64_t>{4});
    for (std::int64_t count = 0; count < 4; ++count) {
        const double expected = 1.0 / (1.0 + rddl::exp(0.5 - static_cast<double>(count)));
        EXPECT_EQ(table.values[count], ir::Value(expected));
    }
}

TEST(TabulateCounts, LooksUpWhatTheChainOfAnEnumerationChooses) {
    const std::string count = "(sum_{?o : obj} p(?o))";
    const auto chain = [&](const std::string& last) {
        return "if (" + count + " == 0) then 7 else if (" + count + " == 1) then 2 else if (" +
               count + " == 2) then 5 else " + last;
    };
    EXPECT_EQ(tabulated(chain("4")), "x-by-count[sum[o in obj](int(state.p[o]))]");
    // Another one chooses as well: what depends on both has no row.
    EXPECT_EQ(
        tabulated(chain("if ([sum_{?o : obj} (v(?o) > 2)] == 1) then 1 else 4")).find("x-by-count"),
        std::string::npos);
}

// A bool as a number, or what is chosen times a constant, is no count of its own.
TEST(TabulateCounts, LooksUpSumsOfCasesThatHold) {
    const std::string count = "(sum_{?o : obj} p(?o))";
    EXPECT_EQ(tabulated("7 * (" + count + " == 0) + 2 * (" + count + " == 1) + 5 * (" + count +
                        " == 2) + 4 * (" + count + " == 3)"),
              "x-by-count[sum[o in obj](int(state.p[o]))]");
    EXPECT_EQ(tabulated("sum_{?u : obj} [(E(?u) + 1) * (if (" + count + " == 1) then 3 else if (" +
                        count + " == 2) then 5 else 7)] * 0.5"),
              "x-by-count[sum[o in obj](int(state.p[o]))]");
}

TEST(TabulateCounts, HasARowForEachObject) {
    EXPECT_EQ(tabulated("sum_{?u : obj} [v(?u) * exp[W(?u) * sum_{?o : obj} p(?o)]]"),
              "sum[u in obj](state.v[u] * x-by-count[u, sum[o in obj](int(state.p[o]))])");
}

TEST(TabulateCounts, RepeatsTheLastEntryThatAnObjectReaches) {
    Problem problem = with_tables(
        "sum_{?u : obj} [v(?u) * exp[W(?u) * (1 + sum_{?o : obj} [NONE(?u, ?o) ^ p(?o) ^ v(?o) > "
        "0])]]");
    problem.non_fluents += "NONE(b1, b2); NONE(b3, b1); NONE(b3, b3);";
    passes::Report report;
    ir::Program program = passes::make_aggregations_sparse(grounded(problem), report);
    program = valid(passes::tabulate_counts(std::move(program), report));
    const ir::Buffer& table = program.buffers.back();
    ASSERT_EQ(table.shape, (std::vector<std::int64_t>{3, 3}));
    const auto e = [](double x) {
        return ir::Value(rddl::exp(x));
    };
    EXPECT_EQ(table.values, (std::vector{e(1), e(2), e(2), e(4), e(4), e(4), e(1), e(2), e(3)}));
}

TEST(TabulateCounts, HasOneRowForObjectsOfAKind) {
    Problem problem =
        with_tables("sum_{?u : obj, ?w : obj} [v(?u) * exp[NONE(?u, ?w) * sum_{?o : obj} p(?o)]]");
    problem.non_fluents += "NONE(b1, b2); NONE(b3, b1);";
    passes::Report report;
    const ir::Program program = valid(passes::tabulate_counts(grounded(problem), report));
    EXPECT_EQ(value_of_x(program),
              "sum[u in obj](sum[w in obj](state.v[u] * "
              "x-by-count[x-kind[u, w], sum[o in obj](int(state.p[o]))]))");
    const auto table = [&](const std::string& name) {
        return *std::ranges::find(program.buffers, name, &ir::Buffer::name);
    };
    const auto e = [](double x) {
        return ir::Value(rddl::exp(x));
    };
    EXPECT_EQ(table("x-by-count").shape, (std::vector<std::int64_t>{2, 4}));
    EXPECT_EQ(table("x-by-count").values,
              (std::vector{e(0), e(0), e(0), e(0), e(0), e(1), e(2), e(3)}));
    EXPECT_EQ(table("x-kind").shape, (std::vector<std::int64_t>{3, 3}));
    const std::vector<std::int64_t> kinds{0, 1, 0, 0, 0, 0, 1, 0, 0};
    EXPECT_EQ(table("x-kind").values, std::vector<ir::Value>(kinds.begin(), kinds.end()));
}

// b1 reaches two of the cases, b2 one and b3 all three.
TEST(TabulateCounts, SharesTheRowOfTheObjectThatReachesFurthest) {
    Problem problem = with_tables(
        "sum_{?u : obj} [v(?u) * exp[SAME(?u) * (1 + sum_{?o : obj} [NONE(?u, ?o) ^ p(?o) ^ v(?o) "
        "> 0])]]");
    problem.non_fluents += "NONE(b1, b2); NONE(b3, b1); NONE(b3, b3);";
    passes::Report report;
    ir::Program program = passes::make_aggregations_sparse(grounded(problem), report);
    program = valid(passes::tabulate_counts(std::move(program), report));
    const ir::Buffer& table = program.buffers.back();
    const auto e = [](double x) {
        return ir::Value(rddl::exp(x));
    };
    EXPECT_EQ(table.shape, std::vector<std::int64_t>{3});
    EXPECT_EQ(table.values, (std::vector{e(1.5), e(3), e(4.5)}));
}

TEST(TabulateCounts, BeginsWithTheLeastCount) {
    EXPECT_EQ(tabulated("exp[0.5 + sum_{?o : obj} (if (p(?o)) then -1 else 0)]"),
              "x-by-count[sum[o in obj](select(state.p[o], -1, 0)) - -3]");
}

TEST(TabulateCounts, TakesSumsOfCounts) {
    EXPECT_EQ(tabulated("exp[(sum_{?o : obj} p(?o)) + sum_{?o : obj} ~p(?o)]"),
              "x-by-count[sum[o in obj](int(state.p[o])) + sum[o in obj](int(!state.p[o]))]");
}

TEST(TabulateCounts, LeavesCheapExpressions) {
    const Texts x = of_x("2.0 * sum_{?o : obj} p(?o) + 1.0", passes::tabulate_counts);
    EXPECT_EQ(x.before, x.after);
}

TEST(TabulateCounts, LeavesWhatDependsOnMore) {
    for (const char* cpf :
         {"exp[x * sum_{?o : obj} p(?o)]", "exp[(sum_{?o : obj} p(?o)) * sum_{?o : obj} ~p(?o)]",
          "exp[0.5 * sum_{?o : obj} (p(?o) * E(?o))]"}) {
        const Texts x = of_x(cpf, passes::tabulate_counts);
        EXPECT_EQ(x.before, x.after);
    }
}

// The value of x, where c is an int of the state with this CPF.
std::string with_counter(const std::string& cpf_of_c, const std::string& cpf_of_x) {
    Problem problem = with_tables(cpf_of_x);
    problem.pvariables += "c : { state-fluent, int, default = 3 };";
    problem.cpfs += "c' = " + cpf_of_c + ";";
    return of_x(grounded(problem), passes::tabulate_counts).after;
}

// Callers set states and horizons, so a test comes first. There are ten steps.
TEST(TabulateCounts, TakesCountersOfStepsAfterATest) {
    EXPECT_EQ(with_counter("c + 2", "x + sin[c / 2.0]"),
              "state.x + select mostly first(state.c >= 3 && state.c <= 23, "
              "x-by-c[maximum(minimum(state.c, 23), 3) - 3], sin(real(state.c) / 2.0))");
    EXPECT_EQ(with_counter("if (c == 4) then 0 else c + 1", "sin[c / 2.0] + cos[x + c]"),
              "select mostly first(state.c >= 0 && state.c <= 4, "
              "x-by-c[maximum(minimum(state.c, 4), 0)], sin(real(state.c) / 2.0)) + "
              "cos(state.x + real(state.c))");
}

TEST(TabulateCounts, TakesCountersWithObjects) {
    EXPECT_EQ(with_counter("c - 1", "sum_{?o : obj} [v(?o) * sin[W(?o) * c]]"),
              "sum[o in obj](state.v[o] * select mostly first(state.c >= -7 && state.c <= 3, "
              "x-by-c[maximum(minimum(state.c, 3), -7) - -7, o], sin(W[o] * real(state.c))))");
}

TEST(TabulateCounts, LeavesIntsThatDoNotCount) {
    for (const char* const cpf : {"if (x > 2) then c + 1 else c", "c + Poisson(1.0)", "c * c * c"})
        EXPECT_EQ(with_counter(cpf, "sin[c / 2.0]"), "sin(real(state.c) / 2.0)") << cpf;
    EXPECT_EQ(with_counter("c + 1", "c + 0.5"), "real(state.c) + 0.5");
}

// Not every int beyond 2^53 is a double, which ranges are of.
TEST(TabulateCounts, LeavesCountsThatAreTooLarge) {
    EXPECT_EQ(tabulated("sin[((exists_{?o : obj} p(?o)) - 9007199254740993) * "
                        "(exists_{?o : obj} p(?o))]"),
              "x-by-count[int(exists[o in obj](state.p[o]))]");
}

// The sine and the cosine of 0 to 3: 0, 0.84, 0.91, 0.14 and 1, 0.54, -0.42, -0.99.
TEST(TabulateCounts, ComparesTheCountWhereABoolAsksForNeighbours) {
    const auto chosen = [](const std::string& condition) {
        return tabulated("if (x > 1.0 | " + condition + ") then 1.0 else 2.0");
    };
    const auto comparing = [](const std::string& test) {
        return "select(state.x > 1.0 || " + test + ", 1.0, 2.0)";
    };
    const std::string count = "sum[o in obj](int(state.p[o]))", ones = "[sum_{?o : obj} p(?o)]";
    EXPECT_EQ(chosen("cos" + ones + " > 0"), comparing(count + " <= 1"));
    EXPECT_EQ(chosen("cos" + ones + " < 0"), comparing(count + " >= 2"));
    EXPECT_EQ(chosen("sin" + ones + " > 0.5"), comparing(count + " >= 1 && " + count + " <= 2"));
    EXPECT_EQ(chosen("sin" + ones + " > 0.9"), comparing(count + " == 2"));
    EXPECT_EQ(chosen("sin" + ones + " < 0.5"), comparing("x-by-count[" + count + "] < 0.5"));
}

TEST(TabulateCounts, MakesAConstantOfEqualEntries) {
    EXPECT_EQ(tabulated("round[sin[sum_{?o : obj} p(?o)] * 0.5] + x"), "0.0 + state.x");
}

TEST(TabulateCounts, KeepsFaults) {
    const Texts x = of_x("1.0 + (0 - 3) * 1.5 + exp[0.0 + pow[2, 1 - sum_{?o : obj} p(?o)]]",
                         passes::tabulate_counts);
    EXPECT_EQ(x.before, x.after);
}

}  // namespace
}  // namespace rddlc
