#include "passes/aggregations/index_directly.hpp"

#include "texts.hpp"

namespace rddlc {
namespace {

// A problem with tables: NEXT has one object a row except for b3, TWO has several; CODE
// distinguishes objects.
Texts of(const std::string& cpf_of_x) {
    Problem problem{
        .pvariables =
            "NEXT(obj, obj) : { non-fluent, bool, default = false };\n"
            "TWO(obj, obj) : { non-fluent, bool, default = false };\n"
            "CODE(obj) : { non-fluent, int, default = 0 };\n"
            "SAME(obj) : { non-fluent, int, default = 7 };\n"
            "x : { state-fluent, real, default = 0.0 };\n"
            "n : { state-fluent, int, default = 0 };\n"
            "at : { state-fluent, color, default = @red };\n"
            "near(obj) : { state-fluent, color, default = @red };\n"
            "p(obj) : { state-fluent, bool, default = false };\n"
            "q(color) : { state-fluent, bool, default = false };\n"
            "v(color) : { state-fluent, real, default = 0.0 };\n"
            "w(obj) : { state-fluent, real, default = 0.0 };\n"
            "root(obj) : { state-fluent, real, default = 0.0 };",
        .cpfs = "x' = " + cpf_of_x +
                ";\nn' = n; at' = at; near'(?o) = near(?o); p'(?o) = p(?o); q'(?c) = q(?c);\n"
                "v'(?c) = v(?c); w'(?o) = w(?o); root'(?o) = sqrt[root(?o)];",
        .non_fluents =
            "NEXT(b1, b2); NEXT(b2, b3); TWO(b1, b2); TWO(b1, b3);\n"
            "CODE(b1) = 10; CODE(b2) = 12; CODE(b3) = 11;"};
    ir::Program program = of_moderate_values(problem);
    const std::string before = value_of_x(program);
    passes::Report report;
    return {before, value_of_x(valid(passes::index_directly(std::move(program), report)))};
}

TEST(IndexDirectly, TakesTheObjectThatIsEqual) {
    const Texts x = of("exists_{?c : color} [at == ?c ^ q(?c)]");
    EXPECT_EQ(x.before, "real(exists[c in color](state.at == c && state.q[c]))");
    EXPECT_EQ(x.after, "real(state.q[state.at])");
    EXPECT_EQ(of("forall_{?c : color} [at == ?c => q(?c)]").after, "real(state.q[state.at])");
    EXPECT_EQ(of("forall_{?c : color} [~(at == ?c ^ q(?c))]").after, "real(!state.q[state.at])");
    EXPECT_EQ(of("sum_{?c : color} [(at == ?c) * v(?c)]").after, "0.0 + state.v[state.at]");
    EXPECT_EQ(of("sum_{?c : color} [if (?c == at) then v(?c) else 0]").after,
              "0.0 + state.v[state.at]")
        << "a sum is never -0.0";
    EXPECT_EQ(of("2.0 + sum_{?c : color} [(at == ?c) * v(?c)]").after, "2.0 + state.v[state.at]");
    EXPECT_EQ(of("sum_{?c : color} [(at == ?c) * abs[v(?c)]]").after,
              "absolute(state.v[state.at])");
    EXPECT_EQ(of("prod_{?c : color} [if (?c == at) then v(?c) else 1]").after, "state.v[state.at]");
}

TEST(IndexDirectly, WorksThroughNests) {
    EXPECT_EQ(of("exists_{?c : color, ?o : obj} [near(?o) == ?c ^ q(?c) ^ p(?o)]").after,
              "real(exists[o in obj](state.q[state.near[o]] && state.p[o]))");
    EXPECT_EQ(of("sum_{?o : obj, ?c : color} [w(?o) * (near(?o) == ?c)]").after,
              "sum[o in obj](state.w[o])");
}

TEST(IndexDirectly, TakesTheOnlyEntryOfARow) {
    EXPECT_EQ(of("sum_{?o : obj} exists_{?u : obj} [NEXT(?o, ?u) ^ p(?u)]").after,
              "real(sum[o in obj](int(NEXT-is-there[o] && state.p[NEXT-object[o]])))");
    const Texts two = of("sum_{?o : obj} exists_{?u : obj} [TWO(?o, ?u) ^ p(?u)]");
    EXPECT_EQ(two.after, two.before);
}

TEST(IndexDirectly, LooksUpWhichObjectHasAValue) {
    EXPECT_EQ(of("sum_{?o : obj} [(CODE(?o) == n) * w(?o)]").after,
              "0.0 + select(state.n >= 10 && state.n <= 12, "
              "state.w[CODE-object[minimum(maximum(state.n, 10), 12) - 10]], 0.0)");
    const Texts same = of("sum_{?o : obj} [(SAME(?o) == n) * w(?o)]");
    EXPECT_EQ(same.after, same.before) << "several objects have the value 7";
}

TEST(IndexDirectly, TestsWhetherThereIsSuchAnObject) {
    EXPECT_EQ(of("exists_{?o : obj} [p(?o) ^ CODE(?o) == 2 * n]").after,
              "real(2 * state.n >= 10 && 2 * state.n <= 12 && "
              "state.p[CODE-object[minimum(maximum(2 * state.n, 10), 12) - 10]])");
}

TEST(IndexDirectly, LeavesWhatOtherObjectsDecide) {
    for (const char* text :
         {"exists_{?c : color} [at == ?c | q(?c)]", "sum_{?c : color} [(at == ?c) + v(?c)]",
          "max_{?c : color} [(at == ?c) * v(?c)]", "exists_{?c : color} [at ~= ?c ^ q(?c)]",
          "sum_{?o : obj} [(at == near(?o)) * w(?o)]"}) {
        const Texts x = of(text);
        EXPECT_EQ(x.after, x.before);
    }
}

TEST(IndexDirectly, LeavesWhatMayBeInfinite) {
    const Texts x = of("sum_{?o : obj} [(CODE(?o) == n) * sqrt[root(?o)]]");
    EXPECT_EQ(x.after, x.before) << "0 * nan is nan";
}

TEST(IndexDirectly, LeavesDrawsAndFaults) {
    for (const char* text : {"sum_{?c : color} [(at == ?c) * Normal(0, 1)]",
                             "sum_{?c : color} [(at == ?c) * lngamma[v(?c)]]"}) {
        const Texts x = of(text);
        EXPECT_EQ(x.after, x.before);
    }
}

}  // namespace
}  // namespace rddlc
