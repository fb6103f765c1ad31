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
            "LINK(obj, obj) : { non-fluent, bool, default = false };\n"
            "at : { state-fluent, obj };\n"
            "P(obj, obj) : { non-fluent, real, default = 0.5 };\n"
            "T(obj, obj) : { non-fluent, real, default = 1.0 };\n"
            "CHANCE(obj, obj) : { non-fluent, real, default = 1.0 };\n"
            "v(obj, obj) : { state-fluent, " +
            type + ", default = " + initial +
            " };\n"
            "s(obj, obj) : { state-fluent, obj };\n"
            "x(obj, obj) : { state-fluent, real, default = 0.0 };\n"
            "a : { action-fluent, bool, default = false };",
        .cpfs = "v'(?o, ?q) = " + cpf_of_v +
                ";\nx'(?o, ?q) = x(?o, ?q);\ns'(?o, ?q) = s(?o, ?q);\nat' = at;",
        .non_fluents =
            "P(b1, b2) = 0.25; LINK(b1, b2) = true; "
            "KIND(b1, b1) = @b2; KIND(b1, b2) = @b3; KIND(b1, b3) = @b1; KIND(b2, b1) = @b3; "
            "KIND(b2, b2) = @b2; KIND(b2, b3) = @b1; KIND(b3, b1) = @b1; KIND(b3, b2) = @b1; "
            "KIND(b3, b3) = @b1; T(b1, b2) = 2.0; CHANCE(b1, b2) = 0.25;",
        .init_state =
            "at = @b1; s(b1, b1) = @b1; s(b1, b2) = @b1; s(b1, b3) = @b1; s(b2, b1) = @b1; "
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

// Loops over words compute both sides of a condition. Others jump.
TEST(ChooseEvaluation, DrawsInWordsWhereTheRestIsOpen) {
    EXPECT_EQ(chosen("Bernoulli(0.25) ^ v(?o, ?q) ^ a", "bool"),
              "select(adjacent state.v[o, q] && action.a, sample bernoulli@0[o * 3 + q](0.25), "
              "false)");
    EXPECT_EQ(chosen("v(?o, ?q) | Bernoulli(0.25) | Bernoulli(0.5)", "bool"),
              "select(adjacent state.v[o, q], true, sample bernoulli@0[o * 3 + q](0.25) || "
              "sample bernoulli@1[o * 3 + q](0.5))");
    EXPECT_EQ(chosen("v(?o, ?q) ^ Bernoulli(0.25) ^ x(?o, ?q) > 1.0", "bool"),
              "adjacent state.v[o, q] && sample bernoulli@0[o * 3 + q](0.25) && "
              "adjacent state.x[o, q] > 1.0");
}

TEST(ChooseEvaluation, SaysWhereSomeDrawsAreCertain) {
    EXPECT_EQ(chosen("Bernoulli(CHANCE(?o, ?q))", "bool"),
              "sample valid bernoulli@0[o * 3 + q](chances CHANCE[o, q])");
    EXPECT_EQ(chosen("Bernoulli(CHANCE(?o, ?q)) ^ x(?o, ?q) > CHANCE(?o, ?q)", "bool"),
              "sample valid bernoulli@0[o * 3 + q](adjacent CHANCE[o, q]) && "
              "adjacent state.x[o, q] > adjacent CHANCE[o, q]")
        << "the values are not bools alone";
}

TEST(ChooseEvaluation, SaysWhereObjectsDrawByOneOfTwoTables) {
    EXPECT_EQ(chosen("Bernoulli(if (x(?o, ?q) > 1.5) then P(?o, ?q) else CHANCE(?o, ?q))", "bool"),
              "sample valid bernoulli@0[o * 3 + q](select both(adjacent state.x[o, q] > 1.5, "
              "chances P[o, q], chances CHANCE[o, q]))");
    EXPECT_EQ(chosen("Bernoulli(if (x(?o, ?q) > 1.5) then P(?o, ?q) else 0.75)", "bool"),
              "sample valid bernoulli@0[o * 3 + q](select both(adjacent state.x[o, q] > 1.5, "
              "adjacent P[o, q], 0.75))")
        << "a number is no table";
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

// The value of x' in the text after the two last passes, where 20 objects are a row.
std::string chosen_for_rows(const std::string& cpf_of_x, const std::string& type = "real") {
    const Problem problem = {
        .pvariables =
            "C(obj, obj) : { non-fluent, bool, default = true };\n"
            "p(obj, obj) : { state-fluent, bool, default = false };\n"
            "q(obj) : { state-fluent, bool, default = false };\n"
            "v(obj) : { state-fluent, real, default = 0.0 };\n"
            "k : { state-fluent, obj };\n"
            "x(obj) : { interm-fluent, " +
            type + " };",
        .cpfs = "x(?o) = " + cpf_of_x +
                ";\np'(?o, ?w) = p(?o, ?w);\nq'(?o) = q(?o);\nv'(?o) = v(?o);\nk' = k;",
        .non_fluents = "C(b1, b2) = false;",
        .init_state = "k = @b1;"};
    passes::Report report;
    ir::Program program = passes::evaluate_together(grounded_with_many(problem), report);
    program = valid(passes::choose_evaluation(std::move(program), report));
    const std::string text = ir::print(program);
    const std::size_t begin = text.find("scratch.x[o] = ") + 15;
    return text.substr(begin, text.find("\n", begin) - begin);
}

TEST(ChooseEvaluation, LoadsABoolForAllObjectsOnce) {
    EXPECT_EQ(chosen("LINK(at, at)", "bool"), "LINK[state.at, state.at]");
}

TEST(ChooseEvaluation, VisitsTrueElementsOfRowsAlone) {
    EXPECT_EQ(chosen_for_rows("sum_{?w : obj} p(?o, ?w)", "int"),
              "sum over true[w in obj](int(state.p[o, w]))");
    EXPECT_EQ(chosen_for_rows("sum_{?w : obj} [if (p(?o, ?w)) then exp[v(?w)] else 0.0]"),
              "sum over true[w in obj](select(state.p[o, w], exp(state.v[w]), 0.0))");
    EXPECT_EQ(chosen_for_rows("sum_{?w : obj} [if (q(?w)) then 3 else 0]", "int"),
              "sum over true[w in obj](select both(state.q[w], 3, 0))");
}

// The same goes for tables of two dimensions, if few are true initially: for q, but not for p.
TEST(ChooseEvaluation, VisitsTrueElementsOfTables) {
    const auto chosen_for_tables = [](const std::string& table) {
        const Problem problem = {
            .pvariables =
                "p(obj, obj) : { state-fluent, bool, default = false };\n"
                "q(obj, obj) : { state-fluent, bool, default = false };\n"
                "v(obj) : { state-fluent, real, default = 0.0 };\n"
                "x : { interm-fluent, real };",
            .cpfs = "x = sum_{?o : obj, ?w : obj} [if (" + table +
                    ") then v(?o) else 0.0];\np'(?o, ?w) = p(?o, ?w);\nq'(?o, ?w) = q(?o, ?w);\n"
                    "v'(?o) = v(?o);",
            .init_state = "q(b1, b2);"};
        passes::Report report;
        const ir::Program program =
            valid(passes::choose_evaluation(grounded_with_many(problem), report));
        const std::string text = ir::print(program);
        const std::size_t begin = text.find("scratch.x = ") + 12;
        return text.substr(begin, text.find("\n", begin) - begin);
    };
    EXPECT_EQ(chosen_for_tables("q(?o, ?w)"),
              "sum over true[o in obj](sum over true[w in obj](select both(state.q[o, w], "
              "state.v[o], 0.0)))");
    EXPECT_EQ(
        chosen_for_tables("p(?o, ?w)"),
        "sum[o in obj](sum over true[w in obj](select both(state.p[o, w], state.v[o], 0.0)))");
    EXPECT_EQ(chosen_for_tables("q(?w, ?o)"),
              "sum[o in obj](sum[w in obj](select both(state.q[w, o], state.v[o], 0.0)))");
}

// Columns, constants, parts of terms, other zeros and elements that the state chooses are no rows.
TEST(ChooseEvaluation, VisitsAllElementsOfOtherSums) {
    for (const char* cpf : {"sum_{?w : obj} [if (p(?o, ?w)) then v(?w) else -0.0]",
                            "sum_{?w : obj} [if (p(?o, ?w)) then v(?w) else 1.0]",
                            "sum_{?w : obj} [if (p(?w, ?w)) then v(?w) else 0.0]",
                            "sum_{?w : obj} [if (p(k, ?w)) then v(?w) else 0.0]",
                            "sum_{?w : obj} [if (C(?o, ?w)) then v(?w) else 0.0]",
                            "prod_{?w : obj} [if (p(?o, ?w)) then v(?w) else 0.0]",
                            "sum_{?w : obj} [if (p(?o, ?w) ^ q(?w)) then v(?w) else 0.0]"})
        EXPECT_EQ(chosen_for_rows(cpf).find("over true"), std::string::npos) << cpf;
    EXPECT_EQ(
        chosen("[sum_{?w : obj} (if (v(?o, ?w)) then 2.0 else 0.0)] > 1.0", "bool").find("over"),
        std::string::npos)
        << "a short row";
}

// The invariant of nine pairs, or the reward, after the pass.
std::string chosen_line(const std::string& name, const std::string& invariant,
                        const std::string& reward = "0") {
    const Problem problem = {.pvariables =
                                 "NEXT(obj, obj) : { non-fluent, obj };\n"
                                 "v(obj, obj) : { state-fluent, real, default = 0.0 };\n"
                                 "w(obj) : { state-fluent, real, default = 0.0 };\n"
                                 "a : { action-fluent, bool, default = false };",
                             .cpfs = "v'(?o, ?q) = v(?o, ?q); w'(?o) = w(?o);",
                             .reward = reward,
                             .blocks = "state-invariants { " + invariant + "; };",
                             .non_fluents =
                                 "NEXT(b1, b1) = @b1; NEXT(b1, b2) = @b1; NEXT(b1, b3) = @b2; "
                                 "NEXT(b2, b1) = @b3; NEXT(b2, b2) = @b1; NEXT(b2, b3) = @b2; "
                                 "NEXT(b3, b1) = @b2; NEXT(b3, b2) = @b1; NEXT(b3, b3) = @b2;"};
    passes::Report report;
    const ir::Program program = valid(passes::choose_evaluation(grounded(problem), report));
    const std::string text = ir::print(program);
    const std::size_t begin = text.find("\n" + name) + 1;
    return text.substr(begin, text.find("\n", begin) - begin);
}
std::string chosen_for_invariant(const std::string& invariant) {
    return chosen_line("invariant", invariant);
}
std::string chosen_for_reward(const std::string& reward) {
    return chosen_line("reward", "forall_{?o : obj} [w(?o) >= 0.0]", reward);
}

TEST(ChooseEvaluation, TestsSeveralObjectsOfAConditionAtOnce) {
    EXPECT_EQ(chosen_for_invariant("forall_{?o : obj, ?q : obj} [v(?o, ?q) >= 0.0]"),
              "invariant 0 = forall several at once[o in obj](forall[q in obj]"
              "(adjacent state.v[o, q] >= 0.0))");
    EXPECT_EQ(
        chosen_for_invariant("~exists_{?o : obj, ?q : obj} [v(NEXT(?o, ?q), NEXT(?o, ?q)) < 0.0]"),
        "invariant 0 = !exists several at once[o in obj](exists[q in obj]"
        "(own state.v[adjacent NEXT[o, q], adjacent NEXT[o, q]] < 0.0))");
}

// In the step and the reward, elements that lie apart are tested one by one.
TEST(ChooseEvaluation, TestsSeveralObjectsOfARewardAtOnce) {
    EXPECT_EQ(chosen_for_reward("exists_{?o : obj, ?q : obj} [v(?o, ?q) > 1.0]"),
              "reward = real(exists several at once[o in obj](exists[q in obj]"
              "(adjacent state.v[o, q] > 1.0)))");
    EXPECT_EQ(
        chosen_for_reward("exists_{?o : obj, ?q : obj} [v(NEXT(?o, ?q), NEXT(?o, ?q)) > 1.0]"),
        "reward = real(exists[o in obj](exists[q in obj](state.v[NEXT[o, q], NEXT[o, q]] > 1.0)))");
}

// Few objects, elements that are not theirs, and what may fault are tested one by one.
TEST(ChooseEvaluation, TestsOtherConditionsOneByOne) {
    for (const char* invariant :
         {"forall_{?o : obj} [w(?o) >= 0.0]", "forall_{?o : obj, ?q : obj} [v(?q, ?o) >= w(?o)]",
          "forall_{?o : obj, ?q : obj} [v(?o, ?q) / w(?o) >= 0.0]"})
        EXPECT_EQ(chosen_for_invariant(invariant).find("several"), std::string::npos) << invariant;
}

TEST(ChooseEvaluation, SaysThatObjectsLoadFromOneRow) {
    EXPECT_EQ(chosen_for_rows("exists_{?w : obj} [p(?w, ?o) ^ q(?w)]", "bool"),
              "exists[w in obj](in row state.p[w, o] && state.q[w])");
    EXPECT_EQ(chosen_for_rows("sum_{?w : obj} [p(?w, ?o) * v(?w)]"),
              "sum[w in obj](real(in row state.p[w, o]) * state.v[w])");
}

}  // namespace
}  // namespace rddlc
