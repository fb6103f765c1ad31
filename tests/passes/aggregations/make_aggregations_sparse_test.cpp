#include "passes/aggregations/make_aggregations_sparse.hpp"

#include "passes/arithmetic/fast_math.hpp"
#include "texts.hpp"

#include <gtest/gtest.h>

namespace rddlc {
namespace {

// A ring of links b1 -> b2 -> b3 -> b1, and one more; two costs.
Problem with_links(const std::string& cpf_of_x) {
    return {.pvariables =
                "LINK(obj, obj) : { non-fluent, bool, default = false };\n"
                "NEXT(obj) : { non-fluent, obj };\n"
                "COST(obj) : { non-fluent, real, default = 0.0 };\n"
                "RISK(obj) : { non-fluent, real, default = 0.0 };\n"
                "x : { state-fluent, real, default = 0.0 };\n"
                "n : { state-fluent, int, default = 0 };\n"
                "v(obj) : { state-fluent, real, default = 0.0 };\n"
                "p(obj) : { state-fluent, bool, default = false };\n"
                "q(obj) : { state-fluent, bool, default = false };",
            .cpfs = "x' = " + cpf_of_x +
                    ";\nn' = n;\nv'(?o) = v(?o);\np'(?o) = p(?o);\nq'(?o) = q(?o);",
            .non_fluents =
                "LINK(b1, b2); LINK(b2, b3); LINK(b3, b1); LINK(b3, b2);\n"
                "NEXT(b1) = b3; NEXT(b2) = b1; NEXT(b3) = b1; COST(b3) = 2.5; RISK(b2) = 1.5;"};
}

ir::Program made_sparse(ir::Program program) {
    passes::Report report;
    program = passes::make_aggregations_sparse(std::move(program), report);
    for (const std::string& complaint : ir::verify(program)) ADD_FAILURE() << complaint;
    return program;
}

std::string sparse(const std::string& cpf_of_x) {
    return value_of_x(made_sparse(of_moderate_values(with_links(cpf_of_x))));
}

std::string sparse_table(const std::string& cpf_of_x, const std::string& name) {
    return table_text(made_sparse(of_moderate_values(with_links(cpf_of_x))), name);
}

TEST(MakeAggregationsSparse, RunsOverTheEntriesOfARow) {
    const std::string cpf =
        "sum_{?o : obj} [v(?o) * (exists_{?u : obj} [LINK(?o, ?u) ^ p(?u) ^ q(?u)])]";
    EXPECT_EQ(sparse(cpf),
              "sum[o in obj](state.v[o] * real(exists[entry in LINK-rows[o] .. LINK-rows[o + 1]]("
              "state.p[LINK-u[entry]] && state.q[LINK-u[entry]])))");
    EXPECT_EQ(sparse_table(cpf, "LINK-rows"), "LINK-rows[4]: int = {0 1 2 4}");
    EXPECT_EQ(sparse_table(cpf, "LINK-u"), "LINK-u[4]: int = {1 2 0 1}");
}

TEST(MakeAggregationsSparse, FlattensNests) {
    EXPECT_EQ(sparse("sum_{?o : obj, ?u : obj} [LINK(?o, ?u) ^ p(?u)]"),
              "real(sum[entry in 0 .. 4](int(state.p[LINK-u[entry]])))");
    EXPECT_EQ(sparse("forall_{?o : obj, ?u : obj} [LINK(?o, ?u) => p(?o) | q(?u)]"),
              "real(forall[entry in 0 .. 4](state.p[LINK-o[entry]] || "
              "state.q[LINK-u[entry]]))");
}

TEST(MakeAggregationsSparse, TakesTheEntryOfRowsThatHaveOne) {
    EXPECT_EQ(sparse("sum_{?o : obj} [v(?o) * (exists_{?u : obj} [?u == NEXT(?o) ^ p(?u) ^ "
                     "q(?u)])]"),
              "sum[o in obj](state.v[o] * real(state.p[NEXT-u[o]] && "
              "state.q[NEXT-u[o]]))");
}

TEST(MakeAggregationsSparse, KnowsThatNoObjectCounts) {
    EXPECT_EQ(sparse("forall_{?o : obj} [p(?o) | COST(?o) >= 0]"), "1.0");
}

// The entries of b3, which the loop around them leaves out.
TEST(MakeAggregationsSparse, KnowsThatNoEntryIsReached) {
    EXPECT_EQ(sparse("sum_{?o : obj} [if (RISK(?o) > 0) then v(?o) + (exists_{?u : obj} "
                     "[COST(?o) > 0 ^ LINK(?o, ?u) ^ (p(?u) | COST(?u) > RISK(?o))]) else 0.0]"),
              "state.v[1] + 0.0");
}

TEST(MakeAggregationsSparse, CountsEqualTerms) {
    EXPECT_EQ(sparse("sum_{?o : obj} v(?o) * (exists_{?u : obj} [LINK(?o, ?u) ^ p(?o) ^ q(?o)])"),
              "sum[o in obj](state.v[o] * real(LINK-rows[o] < LINK-rows[o + 1] && "
              "(state.p[o] && state.q[o])))");
    EXPECT_EQ(sparse("sum_{?o : obj} v(?o) * (sum_{?u : obj} [LINK(?o, ?u) ^ p(?o) ^ q(?o)])"),
              "sum[o in obj](state.v[o] * real((LINK-rows[o + 1] - LINK-rows[o]) * "
              "int(state.p[o] && state.q[o])))");
}

TEST(MakeAggregationsSparse, TabulatesWhatIsFixedForAnEntry) {
    const std::string cpf =
        "sum_{?o : obj, ?u : obj} [LINK(?o, ?u) ^ (p(?o) | COST(?u) > RISK(?o))]";
    EXPECT_EQ(sparse(cpf),
              "real(sum[entry in 0 .. 4](int(state.p[LINK-o[entry]] || "
              "LINK-entries[entry])))");
    EXPECT_EQ(sparse_table(cpf, "LINK-entries"),
              "LINK-entries[4]: bool = {false true false false}");
}

TEST(MakeAggregationsSparse, KeepsSumsOfRealsNested) {
    const std::string cpf = "sum_{?o : obj, ?u : obj} [(RISK(?o) == 0 ^ LINK(?o, ?u)) * v(?u)]";
    EXPECT_EQ(sparse(cpf),
              "sum[entry-2 in 0 .. 2](sum[entry in LINK-rows[entry-2] .. LINK-rows[entry-2 + 1]]("
              "state.v[LINK-u[entry]]))");
    EXPECT_EQ(sparse_table(cpf, "LINK-rows"), "LINK-rows[3]: int = {0 1 3}");
    EXPECT_EQ(sparse_table(cpf, "LINK-u"), "LINK-u[3]: int = {1 0 1}");
    EXPECT_EQ(sparse("sum_{?o : obj, ?u : obj} [LINK(?o, ?u) * v(?u) * v(?u)]"),
              "sum[o in obj](sum[entry in LINK-rows[o] .. LINK-rows[o + 1]]("
              "state.v[LINK-u[entry]] * state.v[LINK-u[entry]]))");
    EXPECT_EQ(sparse("sum_{?o : obj, ?u : obj} [(RISK(?o) == 0) * COST(?u) * v(?o) * v(?u)]"),
              "sum[entry-2 in 0 .. 2](2.5 * state.v[RISK-o[entry-2]] * state.v[x-u[entry-2]])");
}

std::string exactly_sparse(const Problem& problem) {
    return value_of_x(made_sparse(grounded(problem)));
}

// `0.0 * x` is nan if x is inf or nan, as is each omitted term.
TEST(MakeAggregationsSparse, HasOneTermForAllThatMayNotBeFinite) {
    const std::string terms =
        "(if (p(?u)) then 1.5 else 2.5) * (if (q(?u)) then 0.5 else 4.0) * LINK(?o, ?u)";
    EXPECT_EQ(exactly_sparse(with_links("sum_{?o : obj} [COST(?o) * x * (1.0 + RISK(?o))]")),
              "0.0 + (2.5 * state.x + 0.0 * state.x)");
    EXPECT_EQ(exactly_sparse(with_links("sum_{?o : obj} [sum_{?u : obj} [" + terms + " * v(?o)]]")),
              "sum[o in obj](sum[entry in LINK-rows[o] .. LINK-rows[o + 1]]("
              "select(state.p[LINK-u[entry]], 1.5, 2.5) * select(state.q[LINK-u[entry]], 0.5, "
              "4.0) * state.v[o]) + 0.0 * state.v[o])");
    // One term for each object would cost as much as what is left out.
    const std::string other = "sum_{?o : obj} [COST(?o) * v(?o) * v(?o) * v(?o) * v(?o)]";
    EXPECT_EQ(exactly_sparse(with_links(other)), value_of_x(grounded(with_links(other))));
}

// Where factors differ between terms, one test tells whether all of them are finite.
TEST(MakeAggregationsSparse, TestsOnceWhetherAllFactorsAreFinite) {
    const auto with_row = [](const std::string& terms) {
        Problem problem = with_links("sum_{?o : obj} [v(?o) * (sum_{?u : obj} [" + terms + "])]");
        problem.pvariables += "ROW(obj, obj) : { non-fluent, real, default = 0.0 };\n";
        problem.non_fluents += "ROW(b2, b3) = 4.5;";
        return problem;
    };
    const Problem of_columns = with_row("ROW(?o, ?u) * (1.0 / v(?u)) * v(?u) * v(?u) * v(?u)");
    EXPECT_EQ(value_of_x(made_sparse(of_moderate_values(of_columns))),
              "sum[o in obj](state.v[o] * select mostly first("
              "forall[u in obj](0.0 * (1.0 / state.v[u]) == 0.0), "
              "sum[entry in ROW-rows[o] .. ROW-rows[o + 1]]("
              "4.5 * (1.0 / state.v[2]) * state.v[2] * state.v[2] * state.v[2]), "
              "sum[u in obj](ROW[o, u] * (1.0 / state.v[u]) * state.v[u] * state.v[u] * "
              "state.v[u])))");
    EXPECT_EQ(exactly_sparse(of_columns), value_of_x(grounded(of_columns)))
        << "there is a program for moderate values";
    const Problem of_both = with_row("ROW(?o, ?u) * (v(?o) / v(?u)) * v(?u) * v(?u) * v(?u)");
    EXPECT_EQ(value_of_x(made_sparse(of_moderate_values(of_both))),
              value_of_x(of_moderate_values(of_both)));
}

// The product is zero if x is zero, whatever the exponential is.
TEST(MakeAggregationsSparse, LeavesOtherFactorsOfGuardedProducts) {
    const Problem problem = with_links("sum_{?o : obj} [COST(?o) * exp[exp[n]] * x]");
    EXPECT_EQ(exactly_sparse(problem), value_of_x(grounded(problem)));
}

TEST(MakeAggregationsSparse, LeavesFullRowsOfWhatMayNotBeFinite) {
    const auto with_rows = [](const std::string& rows) {
        Problem problem = with_links(
            "sum_{?o : obj} [sum_{?u : obj} [ROW(?o, ?u) * v(?o) * exp[v(?o)] * exp[v(?o)]]]");
        problem.pvariables += "ROW(obj, obj) : { non-fluent, real, default = 0.0 };\n";
        problem.non_fluents += rows;
        return problem;
    };
    const Problem some = with_rows("ROW(b1, b1) = 2.5; ROW(b1, b2) = 3.5; ROW(b2, b3) = 4.5;");
    EXPECT_NE(exactly_sparse(some), value_of_x(grounded(some)));
    const Problem full = with_rows("ROW(b1, b1) = 2.5; ROW(b1, b2) = 3.5; ROW(b1, b3) = 4.5;");
    EXPECT_EQ(exactly_sparse(full), value_of_x(grounded(full)));
}

TEST(MakeAggregationsSparse, LeavesProductsWithWhatMayBeInfinite) {
    const std::string sum = "sum_{?o : obj} COST(?o) * exp[v(?o)] * exp[v(?o)]";
    EXPECT_EQ(sparse(sum), value_of_x(of_moderate_values(with_links(sum))));
    EXPECT_EQ(sparse("sum_{?o : obj} COST(?o) * v(?o) * v(?o) * v(?o)"),
              "0.0 + 2.5 * state.v[2] * state.v[2] * state.v[2]");
}

TEST(MakeAggregationsSparse, FindsZerosThatAreDivided) {
    EXPECT_EQ(sparse("sum_{?o : obj} COST(?o) * v(?o) * v(?o) / 1.5"),
              "0.0 + 2.5 * state.v[2] * state.v[2] / 1.5");
    const std::string by_what_may_be_zero = "sum_{?o : obj} COST(?o) * v(?o) * v(?o) / v(?o)";
    EXPECT_EQ(sparse(by_what_may_be_zero),
              value_of_x(of_moderate_values(with_links(by_what_may_be_zero))));
}

TEST(MakeAggregationsSparse, TakesRealsAsFiniteWithFastMath) {
    passes::Report report;
    const Problem problem = with_links("sum_{?o : obj} COST(?o) * exp[v(?o)]");
    EXPECT_EQ(value_of_x(made_sparse(of_moderate_values(problem))),
              value_of_x(of_moderate_values(problem)));
    EXPECT_EQ(value_of_x(made_sparse(passes::fast_math(of_moderate_values(problem), report))),
              "2.5 * exp(state.v[2])");
}

TEST(MakeAggregationsSparse, LeavesTermsThatMayFault) {
    const std::string fallible =
        "sum_{?o : obj} [Bernoulli(v(?o)) ^ COST(?o) ~= 0 ^ q(?o) ^ p(?o)]";
    EXPECT_EQ(sparse(fallible), value_of_x(of_moderate_values(with_links(fallible))));
    EXPECT_EQ(
        sparse("sum_{?o : obj} (if (COST(?o) ~= 0) then Bernoulli(v(?o)) ^ p(?o) else false)"),
        "real(select(state.p[2], sample bernoulli@0[2](state.v[2]), false))");
}

TEST(MakeAggregationsSparse, TakesTablesThatAreTooLargeToTryAll) {
    Problem problem = with_links(
        "sum_{?a : obj, ?b : obj, ?c : obj, ?d : obj, ?e : obj, ?f : obj, ?g : obj, ?h : obj, "
        "?i : obj, ?j : obj, ?k : obj, ?l : obj, ?m : obj, ?n : obj} "
        "[FAR(?a, ?b, ?c, ?d, ?e, ?f, ?g, ?h, ?i, ?j, ?k, ?l, ?m, ?n) > 1.5 ^ p(?n)]");
    problem.pvariables +=
        "FAR(obj, obj, obj, obj, obj, obj, obj, obj, obj, obj, obj, obj, obj, obj) : "
        "{ non-fluent, real, default = 0.5 };\n";
    problem.non_fluents +=
        "FAR(b1, b1, b1, b1, b1, b1, b1, b1, b1, b1, b1, b1, b1, b3) = 2.5;\n"
        "FAR(b1, b1, b1, b1, b1, b1, b1, b1, b1, b1, b1, b1, b2, b1) = 1.0;\n"
        "FAR(b2, b1, b1, b1, b1, b1, b1, b1, b1, b1, b1, b1, b2, b2) = 4.0;\n";
    EXPECT_EQ(value_of_x(made_sparse(of_moderate_values(problem))),
              "real(sum[entry in 0 .. 2](int(state.p[FAR-n[entry]])))");
}

// Neighbours infect each other, depending on the season.
Problem with_seasons(const std::string& cpf_of_x) {
    Problem problem = with_links(cpf_of_x);
    problem.pvariables +=
        "RATE(obj, obj, color) : { non-fluent, real, default = 0.0 };\n"
        "season : { state-fluent, color, default = @red };";
    problem.cpfs += "season' = season;";
    problem.non_fluents +=
        "RATE(b1, b2, @red) = 0.25; RATE(b1, b2, @blue) = 0.5; RATE(b3, b2, @green) = 0.75;";
    return problem;
}

TEST(MakeAggregationsSparse, LeavesOutFactorsOfOne) {
    EXPECT_EQ(sparse("sum_{?o : obj} [v(?o) * (prod_{?u : obj} [1.0 - LINK(?o, ?u) * p(?u) * "
                     "q(?u) * 0.5])]"),
              "sum[o in obj](state.v[o] * prod[entry in LINK-rows[o] .. LINK-rows[o + 1]](1.0 - "
              "real(int(state.p[LINK-u[entry]]) * int(state.q[LINK-u[entry]])) * 0.5))");
}

TEST(MakeAggregationsSparse, LeavesOutWhatNoIndexOfATableChooses) {
    const Problem problem = with_seasons(
        "sum_{?o : obj} [v(?o) * (prod_{?u : obj} [1.0 - p(?u) * q(?u) * (RATE(?o, ?u, season) + "
        "RATE(?o, ?u, season) * RATE(?o, ?u, season))])]");
    const ir::Program program = made_sparse(of_moderate_values(problem));
    EXPECT_EQ(value_of_x(program),
              "sum[o in obj](state.v[o] * select(RATE-is-there[o], 1.0 - "
              "real(int(state.p[RATE-u[o]]) * int(state.q[RATE-u[o]])) * "
              "RATE-entries[o, state.season], 1.0))");
    EXPECT_EQ(table_text(program, "RATE-entries"),
              "RATE-entries[3, 3]: real = {0.3125 0.0 0.75 0.0 1.3125 0.0 0.0 1.3125 0.0}");
}

// Two rows have an entry, and one has none.
Problem with_ways(const std::string& cpf_of_x) {
    Problem problem = with_links(cpf_of_x);
    problem.pvariables += "WAY(obj, obj) : { non-fluent, real, default = 0.0 };";
    problem.non_fluents += "WAY(b1, b2) = 0.5; WAY(b3, b1) = 0.5;";
    return problem;
}

TEST(MakeAggregationsSparse, TakesTheOnlyEntryOfARow) {
    const ir::Program program = made_sparse(of_moderate_values(with_ways(
        "sum_{?o : obj} [v(?o) * (prod_{?u : obj} [1.0 - p(?u) * q(?u) * WAY(?o, ?u)])]")));
    EXPECT_EQ(value_of_x(program),
              "sum[o in obj](state.v[o] * select(WAY-is-there[o], 1.0 - "
              "real(int(state.p[WAY-u[o]]) * int(state.q[WAY-u[o]])) * 0.5, 1.0))");
    EXPECT_EQ(table_text(program, "WAY-is-there"), "WAY-is-there[3]: bool = {true false true}");
    EXPECT_EQ(table_text(program, "WAY-u"), "WAY-u[3]: int = {1 0 0}");
}

TEST(MakeAggregationsSparse, KnowsWhatConstantsDecide) {
    EXPECT_EQ(sparse("sum_{?o : obj} [v(?o) * (forall_{?u : obj} [LINK(?o, ?u) ^ p(?u)])]"),
              "sum[o in obj](state.v[o] * 0.0)");
    EXPECT_EQ(sparse("sum_{?o : obj} [v(?o) * (exists_{?u : obj} [~LINK(?o, ?u) | p(?u)])]"),
              "sum[o in obj](state.v[o])");
}

TEST(MakeAggregationsSparse, LeavesWhatConstantsDecideInSomeRows) {
    EXPECT_EQ(sparse("sum_{?o : obj} [v(?o) * (forall_{?u : obj} [(LINK(?o, ?u) | COST(?o) > 1.0) "
                     "^ p(?u)])]"),
              "sum[o in obj](state.v[o] * real(forall[u in obj]((LINK[o, u] || COST[o] > 1.0) && "
              "state.p[u])))");
}

TEST(MakeAggregationsSparse, LeavesDenseTables) {
    const std::string sum = "sum_{?o : obj, ?u : obj} [~LINK(?o, ?u) ^ p(?u)]";
    EXPECT_EQ(sparse(sum), value_of_x(of_moderate_values(with_links(sum))));
}

TEST(MakeAggregationsSparse, KnowsRowsInsideOfEntries) {
    EXPECT_EQ(sparse("sum_{?o : obj} [RISK(?o) * (sum_{?u : obj} [LINK(?o, ?u) * v(?u) * v(?u)])]"),
              "1.5 * (state.v[2] * state.v[2])");
}

}  // namespace
}  // namespace rddlc
