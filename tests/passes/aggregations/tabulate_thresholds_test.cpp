#include "passes/aggregations/tabulate_thresholds.hpp"

#include "texts.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace rddlc {
namespace {

// c and h(?o) are colors; P(?o) is 0.25, and 0.75 for b2.
ir::Program with_cpfs(const std::string& cpf_of_c, const std::string& cpf_of_h = "h(?o)") {
    return grounded({.pvariables = "P(obj) : { non-fluent, real, default = 0.25 };\n"
                                   "c : { state-fluent, color, default = @red };\n"
                                   "h(obj) : { state-fluent, color, default = @red };\n"
                                   "p : { state-fluent, bool, default = false };\n"
                                   "x : { state-fluent, real, default = 0.0 };",
                     .cpfs = "c' = " + cpf_of_c + ";\nh'(?o) = " + cpf_of_h + ";\np' = p;\nx' = x;",
                     .non_fluents = "P(b2) = 0.75;"});
}

struct Tabulated {
    passes::Report report;
    ir::Program program;

    explicit Tabulated(ir::Program before)
        : program(valid(passes::tabulate_thresholds(std::move(before), report))) {}

    // The line that fills the next value of a fluent.
    std::string cpf_of(const std::string& name) const {
        const std::string text = step_text(program), head = "next." + name;
        const std::size_t begin = text.find(head);
        return text.substr(begin, text.find('\n', begin) - begin);
    }
    std::vector<ir::Value> table() const { return program.buffers.back().values.dense(); }
    std::vector<std::int64_t> shape() const { return program.buffers.back().shape; }
};

TEST(TabulateThresholds, AddsConstantWeights) {
    const Tabulated made(with_cpfs("Discrete(color, @red : 0.25, @green : 0.5, @blue : 0.25)"));
    EXPECT_EQ(made.cpf_of("c"), "next.c = sample interval@0[0](c-thresholds)");
    EXPECT_EQ(made.table(), (std::vector<ir::Value>{0.25, 0.75}));
    EXPECT_EQ(made.report.at("draws made searches among thresholds"), 1);
}

TEST(TabulateThresholds, GivesTheFirstIndexWhatIsMissing) {
    const Tabulated made(with_cpfs("Discrete(color, @red : 0.25, @green : 0.5, @blue : 0.249995)"));
    EXPECT_EQ(made.cpf_of("c"),
              "next.c = select(sample interval@0[0](c-thresholds) < 3, "
              "sample interval@0[0](c-thresholds), 0)");
    EXPECT_EQ(made.table(), (std::vector<ir::Value>{0.25, 0.75, 0.999995}));
}

TEST(TabulateThresholds, LeavesOutWhatNoNumberReaches) {
    const Tabulated made(with_cpfs("Discrete(color, @red : 0.25, @green : 0.75, @blue : 0)"));
    EXPECT_EQ(made.table(), (std::vector<ir::Value>{0.25}));
    const Tabulated certain(with_cpfs("Discrete(color, @red : 1, @green : 0, @blue : 0)"));
    EXPECT_EQ(certain.cpf_of("c"), "next.c = 0");
}

TEST(TabulateThresholds, HasARowForEachObjectAndInt) {
    const Tabulated made(with_cpfs(
        "c",
        "Discrete(color, @red : if (h(?o) == @red) then P(?o) else 1 - P(?o), @green : 0, "
        "@blue : if (h(?o) == @red) then 1 - P(?o) else P(?o))"));
    EXPECT_EQ(made.cpf_of("h"),
              "next.h[o] = sample interval@0[o](h-thresholds[o, int(state.h[o] == 0)])");
    EXPECT_EQ(made.shape(), (std::vector<std::int64_t>{3, 2, 2}));
    EXPECT_EQ(made.table(), (std::vector<ir::Value>{0.75, 0.75, 0.25, 0.25, 0.25, 0.25, 0.75, 0.75,
                                                    0.75, 0.75, 0.25, 0.25}));
}

// No color is both red and green.
TEST(TabulateThresholds, ChoosesByAnIntWhereBoolsExcludeEachOther) {
    const Tabulated made(
        with_cpfs("Discrete(color, @red : if (c == @red) then 0.5 else 0, "
                  "@green : if (c == @green) then 0.5 else 0, "
                  "@blue : if (c == @blue) then 1 else 0.5)"));
    EXPECT_EQ(made.cpf_of("c"), "next.c = sample interval@0[0](c-thresholds[state.c])");
    EXPECT_EQ(made.table(), (std::vector<ir::Value>{0.5, 0.5, 0.0, 0.5, 0.0, 0.0}));
}

TEST(TabulateThresholds, TakesElementsOfTables) {
    const Tabulated made(
        grounded({.pvariables = "P(color, color) : { non-fluent, real, default = 0.25 };\n"
                                "c : { state-fluent, color, default = @red };",
                  .cpfs = "c' = Discrete(color, @red : P(c, @red), @green : P(c, @green), "
                          "@blue : P(c, @blue));",
                  .non_fluents = "P(@red, @red) = 0.5;\nP(@green, @green) = 0.5;\n"
                                 "P(@blue, @blue) = 0.5;"}));
    EXPECT_EQ(made.cpf_of("c"), "next.c = sample interval@0[0](c-thresholds[state.c])");
    EXPECT_EQ(made.table(), (std::vector<ir::Value>{0.5, 0.75, 0.25, 0.75, 0.25, 0.5}));
}

TEST(TabulateThresholds, TakesWeightsOfObjects) {
    const Tabulated made(with_cpfs("h(Discrete_{?o : obj} (P(?o) * 0.8))"));
    EXPECT_EQ(made.cpf_of("c"), "next.c = state.h[sample interval@0[0](c-thresholds)]");
    EXPECT_EQ(made.table(), (std::vector<ir::Value>{0.2, 0.2 + 0.6000000000000001}));
}

TEST(TabulateThresholds, MakesOneDrawOfTwoBranches) {
    const Tabulated made(
        with_cpfs("if (x > 1) then Discrete(color, @red : 0.5, @green : 0.25, @blue : 0.25) "
                  "else if (p) then Discrete(color, @red : 0.25, @green : 0.5, @blue : 0.25) "
                  "else Discrete(color, @red : 0.25, @green : 0.25, @blue : 0.5)"));
    EXPECT_EQ(made.cpf_of("c"),
              "next.c = sample interval@0[0](c-thresholds-5[select(state.x > 1.0, 0, "
              "select(state.p, 1, 2))])");
    EXPECT_EQ(made.table(), (std::vector<ir::Value>{0.5, 0.75, 0.25, 0.75, 0.25, 0.5}));
}

TEST(TabulateThresholds, FindsCountsByTheirNumbers) {
    const Tabulated made(grounded({.pvariables = "P(obj) : { non-fluent, real, default = 0.25 };\n"
                                                 "n(obj) : { state-fluent, int, default = 0 };\n"
                                                 "m(obj) : { state-fluent, int, default = 0 };\n"
                                                 "p : { state-fluent, bool, default = false };",
                                   .cpfs = "n'(?o) = Poisson(if (p) then P(?o) else 1.0);\n"
                                           "m'(?o) = Binomial(3, P(?o));\np' = ~p;",
                                   .non_fluents = "P(b2) = 0.5;"}));
    EXPECT_EQ(made.cpf_of("n"), "next.n[o] = sample interval@1[o](n-thresholds[o, int(state.p)])");
    EXPECT_EQ(made.cpf_of("m"), "next.m[o] = sample interval@0[o](m-thresholds[o])");
    EXPECT_EQ(made.shape(), (std::vector<std::int64_t>{3, 2, 17}));
    EXPECT_EQ(made.report.at("draws made searches among thresholds"), 2);
}

TEST(TabulateThresholds, LeavesCountsThatNoWalkFinds) {
    for (const char* cpf : {"Poisson(10.0)", "Poisson(-1.0)", "Poisson(x)", "Binomial(-1, 0.25)",
                            "Binomial(40, 0.3)", "Geometric(0.25)"}) {
        const auto before = [&] {
            return grounded({.pvariables = "n : { state-fluent, int, default = 0 };\n"
                                           "x : { state-fluent, real, default = 0.0 };",
                             .cpfs = std::string("n' = ") + cpf + ";\nx' = x;"});
        };
        EXPECT_EQ(step_text(Tabulated(before()).program), step_text(before())) << cpf;
        ir::Program floats = before();
        floats.real = RealType::Float;
        EXPECT_EQ(step_text(Tabulated(std::move(floats)).program), step_text(before())) << cpf;
    }
}

TEST(TabulateThresholds, CountsFailuresWhereTheyAreRarer) {
    const Tabulated made(grounded({.pvariables = "n : { state-fluent, int, default = 0 };",
                                   .cpfs = "n' = Binomial(2, 0.75);"}));
    EXPECT_EQ(made.cpf_of("n"), "next.n = 2 - sample interval@0[0](n-thresholds)");
    EXPECT_EQ(made.table(), (std::vector<ir::Value>{0.5625, 0.9375}));
}

TEST(TabulateThresholds, TakesDrawsForInts) {
    const Tabulated made(grounded({.pvariables = "n : { state-fluent, int, default = 0 };",
                                   .cpfs = "n' = Binomial(Binomial(2, 0.5), 0.5);"}));
    EXPECT_EQ(made.cpf_of("n"),
              "next.n = sample interval@1[0](n-thresholds-2[sample interval@0[0](n-thresholds)])");
    EXPECT_EQ(made.shape(), (std::vector<std::int64_t>{3, 2}));
}

TEST(TabulateThresholds, MakesOneDrawOfTwoRates) {
    const Tabulated made(
        grounded({.pvariables = "n : { state-fluent, int, default = 0 };\n"
                                "p : { state-fluent, bool, default = false };",
                  .cpfs = "n' = if (p) then Binomial(1, 0.5) else Binomial(2, 0.5);\np' = ~p;"}));
    EXPECT_EQ(made.cpf_of("n"),
              "next.n = sample interval@0[0](n-thresholds-3[select(state.p, 0, 1)])");
    EXPECT_EQ(made.table(), (std::vector<ir::Value>{0.5, 1.0, 0.25, 0.75}));
}

TEST(TabulateThresholds, LeavesDrawsThatMayFaultOrDependOnMore) {
    for (const char* cpf : {"Discrete(color, @red : 0.25, @green : 0.5, @blue : 0.5)",
                            "Discrete(color, @red : -0.25, @green : 0.75, @blue : 0.5)",
                            "Discrete(color, @red : x, @green : 0.5, @blue : 0.5)",
                            "Discrete(color, @red : if (p) then 1 else 0.5, @green : 0, @blue : 0)",
                            "UnnormDiscrete(color, @red : 0.25, @green : 0.5, @blue : 0.25)"}) {
        const ir::Program before = with_cpfs(cpf);
        EXPECT_EQ(step_text(Tabulated(before).program), step_text(before)) << cpf;
    }
}

TEST(TabulateThresholds, AddsFloatsAsSuch) {
    ir::Program before = with_cpfs("Discrete(color, @red : 0.1, @green : 0.2, @blue : 0.7)");
    before.real = RealType::Float;
    const Tabulated made(std::move(before));
    EXPECT_EQ(made.cpf_of("c"), "next.c = sample interval@0[0](c-thresholds)");
    EXPECT_EQ(made.table(), (std::vector<ir::Value>{double{0.1F}, double{0.1F + 0.2F}}));
}

}  // namespace
}  // namespace rddlc
