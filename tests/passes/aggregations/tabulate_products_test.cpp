#include "passes/aggregations/tabulate_products.hpp"

#include "texts.hpp"

namespace rddlc {
namespace {

// Nine of 20 objects have a weight, and two others another weight of 0.
Texts of_product(const std::string& cpf_of_x) {
    Problem problem = with_tables(cpf_of_x);
    problem.pvariables += "OTHER(obj) : { non-fluent, real, default = 1.0 };";
    problem.non_fluents =
        "W(b1) = 0.5; W(b2) = 0.75; W(b4) = 1.25; W(b5) = 1.5; W(b6) = 1.75; W(b7) = 2.0; "
        "W(b8) = 2.25; W(b9) = 2.5; W(b10) = 2.75; OTHER(b3) = 0.0; OTHER(b12) = 0.0;";
    return of_x(grounded_with_many(problem), passes::tabulate_products);
}

const std::string weights = "(prod_{?a : obj} [if (p(?a)) then W(?a) else 1.0])";
const std::string looked_up =
    "p-products[bit_and(bits(state.p, 0), 31)] * p-products-2[bit_and(shift_right(bits(state.p, "
    "0), 5), 31)]";

TEST(TabulateProducts, LooksUpSeveralBoolsAtOnce) {
    EXPECT_EQ(of_product(weights).after, looked_up);
    EXPECT_EQ(of_product("x * " + weights).after, "state.x * (" + looked_up + ")");
}

TEST(TabulateProducts, TestsTheBoolsThatMakeItZero) {
    EXPECT_EQ(of_product("prod_{?a : obj} [if (p(?a)) then W(?a) else OTHER(?a)]").after,
              "select(bit_and(bits(state.p, 0), 2052) == 2052, " + looked_up + ", 0.0)");
    EXPECT_EQ(of_product("prod_{?a : obj} [if (~p(?a)) then W(?a) * 2.0 else OTHER(?a)]").after,
              "select(bit_and(bits(state.p, 0), 2052) == 0, " + looked_up +
                  " * p-products-3[bit_and(shift_right(bits(state.p, 0), 10), 31)] * "
                  "p-products-3[bit_and(shift_right(bits(state.p, 0), 15), 31)], 0.0)");
}

// Products that round, that may be negative, that have several factors of a bool, or few.
TEST(TabulateProducts, LeavesOtherProducts) {
    for (const std::string factor : {"0.1", "-2.0", "-0.0"}) {
        const Texts x = of_product("prod_{?a : obj} [if (p(?a)) then " + factor + " else W(?a)]");
        EXPECT_EQ(x.before, x.after);
    }
    const Texts twice = of_product(weights + " * " + weights);
    EXPECT_EQ(twice.after, looked_up + " * (" + looked_up + ")");
    const Texts few =
        of_x("prod_{?a : obj} [if (p(?a)) then 0.5 else 1.0]", passes::tabulate_products);
    EXPECT_EQ(few.before, few.after);
}

// Environments of a pack would take the bits of different rows.
TEST(TabulateProducts, LeavesRowsThatTheStateChooses) {
    Problem problem = with_tables("prod_{?a : obj} [if (old(which, ?a)) then 0.5 else 0.75]");
    problem.pvariables +=
        "which : { state-fluent, pair };\n"
        "old(pair, obj) : { state-fluent, bool, default = false };";
    problem.cpfs += "which' = which; old'(?d, ?o) = old(?d, ?o);";
    problem.init_state = "which = a1;";
    const Texts x = of_x(grounded_with_many(problem), passes::tabulate_products);
    EXPECT_EQ(x.before, x.after);
}

}  // namespace
}  // namespace rddlc
