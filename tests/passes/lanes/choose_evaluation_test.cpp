#include "passes/lanes/choose_evaluation.hpp"

#include "passes/lanes/evaluate_together.hpp"
#include "texts.hpp"

#include <string>

namespace rddlc {
namespace {

// The text of the CPF of `v` of nine pairs of objects, after the two last passes.
std::string chosen(const std::string& cpf_of_v, const std::string& type = "real") {
    const std::string initial = type == "real" ? "0.0" : "false";
    const Problem problem = {
        .pvariables =

            "KIND(obj, obj) : { non-fluent, obj };\n"
            "P(obj, obj) : { non-fluent, real, default = 0.5 };\n"
            "T(obj, obj) : { non-fluent, real, default = 1.0 };\n"
            "v(obj, obj) : { state-fluent, " +
            type + ", default = " + initial +
            " };\n"
            "s(obj, obj) : { state-fluent, obj };\n"
            "x(obj, obj) : { state-fluent, real, default = 0.0 };\n"
            "a : { action-fluent, bool, default = false };",
        .cpfs = "v'(?o, ?q) = " + cpf_of_v + ";\nx'(?o, ?q) = x(?o, ?q);\ns'(?o, ?q) = s(?o, ?q);",
        .non_fluents =
            "P(b1, b2) = 0.25; "
            "KIND(b1, b1) = @b2; KIND(b1, b2) = @b3; KIND(b1, b3) = @b1; KIND(b2, b1) = @b3; "
            "KIND(b2, b2) = @b2; KIND(b2, b3) = @b1; KIND(b3, b1) = @b1; KIND(b3, b2) = @b1; "
            "KIND(b3, b3) = @b1; T(b1, b2) = 2.0;",
        .init_state =
            "s(b1, b1) = @b1; s(b1, b2) = @b1; s(b1, b3) = @b1; s(b2, b1) = @b1; "
            "s(b2, b2) = @b1; s(b2, b3) = @b1; s(b3, b1) = @b1; s(b3, b2) = @b1; "
            "s(b3, b3) = @b1;"};
    passes::Report report;
    ir::Program program = passes::evaluate_together(grounded(problem), report);
    program = valid(passes::choose_evaluation(std::move(program), report));
    const std::string text = ir::print(program);
    const std::size_t begin = text.find("next.v[o, q] = ") + 15;
    return text.substr(begin, text.find("\n", begin) - begin);
}

TEST(ChooseEvaluation, EvaluatesBothValuesWhereBothAreCheap) {
    EXPECT_EQ(chosen("if (a) then x(?o, ?q) else 1.0"),
              "select both(action.a, state.x[o, q], 1.0)");
}

TEST(ChooseEvaluation, JumpsAroundWhatIsNotCheap) {
    const std::string sum = "(sum_{?p : obj} [x(?p, ?q) * T(?p, ?o)])";
    EXPECT_EQ(chosen("if (a) then " + sum + " else 1.0").find("select both in packs(action.a"), 0);
    EXPECT_EQ(chosen("if (a) then exp[" + sum + "] else 1.0").find("select(action.a"), 0);
    EXPECT_EQ(chosen("if (a) then Normal(" + sum + ", 1.0) else 1.0").find("select(action.a"), 0);
}

TEST(ChooseEvaluation, LooksAtAllOfAChain) {
    const std::string sum = "(sum_{?p : obj} [x(?p, ?q) * T(?p, ?o)])";
    const std::string chain = "if (a) then " + sum + " else if (x(?o, ?q) > 1.0) then ";
    EXPECT_EQ(chosen(chain + sum + " * 2.0 else 1.0").find("select both in packs(action.a"), 0);
    EXPECT_EQ(chosen(chain + "exp[" + sum + "] else 1.0").find("select(action.a"), 0);
}

TEST(ChooseEvaluation, ChecksProbabilitiesThatMayBeNone) {
    EXPECT_EQ(chosen("Bernoulli(P(?o, ?q))", "bool"),
              "sample valid bernoulli@0[o * 3 + q](adjacent P[o, q])");
    EXPECT_EQ(chosen("Bernoulli(x(?o, ?q))", "bool"),
              "sample bernoulli@0[o * 3 + q](adjacent state.x[o, q])");
    EXPECT_EQ(chosen("Bernoulli(0.25)", "bool"), "sample bernoulli@0[o * 3 + q](0.25)");
}

TEST(ChooseEvaluation, RoundsWithoutAnInt) {
    EXPECT_EQ(chosen("round[x(?o, ?q)] + 0.5"), "rounded real(round(state.x[o, q])) + 0.5");
}

TEST(ChooseEvaluation, SaysHowObjectsLoad) {
    EXPECT_EQ(
        chosen("v(?o, ?q) | (T(KIND(?o, ?q), s(?o, ?q)) > 1.5)", "bool"),
        "adjacent state.v[o, q] || rows T[adjacent KIND[o, q], adjacent state.s[o, q]] > 1.5");
    EXPECT_EQ(chosen("a | (T(s(?o, ?q), s(?o, ?q)) > 1.5)", "bool"),
              "action.a || own T[adjacent state.s[o, q], adjacent state.s[o, q]] > 1.5");
}

}  // namespace
}  // namespace rddlc
