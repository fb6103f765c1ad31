#include "passes/lanes/evaluate_together.hpp"

#include "passes/aggregations/tabulate_thresholds.hpp"
#include "texts.hpp"

#include <string>

namespace rddlc {
namespace {

// Nine pairs of objects; the CPF of `on` is given.
Problem with_pairs(const std::string& cpf_of_on) {
    return {
        .pvariables =
            "P(obj, obj) : { non-fluent, real, default = 0.5 };\n"
            "W(obj) : { non-fluent, real, default = 0.25 };\n"
            "on(obj, obj) : { state-fluent, bool, default = false };\n"
            "v(obj, obj) : { state-fluent, real, default = 0.0 };\n"
            "w(obj) : { state-fluent, bool, default = false };\n"
            "a : { action-fluent, bool, default = false };",
        .cpfs = "on'(?x, ?y) = " + cpf_of_on + ";\nv'(?x, ?y) = v(?x, ?y) + 1.0;\nw'(?x) = ~w(?x);",
        .non_fluents = "P(b1, b2) = 0.25; W(b2) = 0.5;"};
}

// How the loop over the pairs runs.
std::string loop_for(const std::string& cpf_of_on) {
    passes::Report report;
    const ir::Program program =
        valid(passes::evaluate_together(grounded(with_pairs(cpf_of_on)), report));
    const std::string text = ir::print(program);
    const std::size_t end = text.find("\n", text.find("step\n") + 5);
    return text.substr(text.find("step\n") + 9, end - text.find("step\n") - 9);
}

TEST(EvaluateTogether, TakesLoopsThatDrawOrGiveBools) {
    for (const char* cpf : {"Normal(v(?x, ?y), 1.0) > 2.0", "v(?x, ?y) > 2.0",
                            "Bernoulli(v(?x, ?y))", "Bernoulli(if (a) then 0.25 else 0.5)"})
        EXPECT_EQ(loop_for(cpf), "for x in obj, several at once") << cpf;
}

// Draws with constant probabilities also.
TEST(EvaluateTogether, KeepsBoolsAloneInRegisters) {
    for (const char* cpf :
         {"Bernoulli(P(?x, ?y))", "on(?x, ?y) | a", "if (a) then Bernoulli(0.3) else on(?x, ?y)"})
        EXPECT_EQ(loop_for(cpf), "for x in obj, as words") << cpf;
}

// `w(?y)` does not lie beside its neighbours for all pairs, only for those of one ?x.
TEST(EvaluateTogether, TakesLoopsInsideOfOthers) {
    const auto loops = [](const std::string& cpf_of_on) {
        Problem problem = with_pairs(cpf_of_on);
        problem.pvariables += "\nk(obj, obj) : { state-fluent, int, default = 0 };";
        problem.cpfs += "\nk'(?x, ?y) = k(?x, ?y);";
        passes::Report report;
        const std::string text =
            ir::print(valid(passes::evaluate_together(grounded_with_many(problem), report)));
        const std::size_t store = text.find("next.on");
        const std::size_t begin = text.rfind("for x in obj", store);
        return text.substr(begin, store - begin);
    };
    EXPECT_EQ(loops("w(?y) ^ v(?x, ?y) > 1.0"),
              "for x in obj\n        for y in obj, several at once\n            ");
    EXPECT_EQ(loops("w(?y) ^ on(?x, ?y)"),
              "for x in obj\n        for y in obj, as words\n            ");
    EXPECT_EQ(loops("w(?y) ^ k(?x, ?y) > 1"), "for x in obj\n        for y in obj\n            ");
    EXPECT_EQ(loops("w(?y) ^ on(?y, ?x)"), "for x in obj\n        for y in obj\n            ");
}

// Reals of the state at places from tables of constants are gathered.
TEST(EvaluateTogether, TakesInnerLoopsThatGatherOrComputeReals) {
    const auto inner_loop = [](const std::string& cpf_of_v) {
        Problem problem = with_pairs("on(?x, ?y)");
        problem.pvariables +=
            "\nNEXT(obj) : { non-fluent, obj };"
            "\nk(obj) : { state-fluent, int, default = 0 };";
        for (int i = 1; i <= 20; ++i)
            problem.non_fluents +=
                " NEXT(b" + std::to_string(i) + ") = b" + std::to_string(i % 20 + 1) + ";";
        problem.cpfs = "on'(?x, ?y) = on(?x, ?y); v'(?x, ?y) = " + cpf_of_v +
                       "; w'(?x) = ~w(?x); k'(?x) = k(?x) + 1;";
        passes::Report report;
        const std::string text =
            ir::print(valid(passes::evaluate_together(grounded_with_many(problem), report)));
        const std::size_t begin = text.rfind("for y in", text.find("next.v"));
        return text.substr(begin, text.find("\n", begin) - begin);
    };
    EXPECT_EQ(inner_loop("1.0 / v(?x, NEXT(?y)) + sqrt[v(?x, ?x)]"),
              "for y in obj, several at once");
    EXPECT_EQ(inner_loop("(k(?x) == k(?y)) * sqrt[v(?x, ?y)] / v(?x, ?x)"),
              "for y in obj, several at once");
    EXPECT_EQ(inner_loop("(k(?x) == k(?y)) * v(?x, ?y)"), "for y in obj");
}

TEST(EvaluateTogether, TakesLoopsOverRealsThatAreNotCheap) {
    const auto marked = [](const std::string& cpf_of_v) {
        Problem problem = with_pairs("a");
        problem.cpfs = "on'(?x, ?y) = a;\nv'(?x, ?y) = " + cpf_of_v + ";\nw'(?x) = ~w(?x);";
        passes::Report report;
        passes::evaluate_together(grounded(problem), report);
        return report["loops over several objects at once"] - 1;  // that of `on` is one
    };
    EXPECT_EQ(marked("exp[v(?x, ?y)]"), 1);
    EXPECT_EQ(marked("max[0.0, min[v(?x, ?y), P(?x, ?y)]] + 2 * v(?x, ?y)"), 1);
    EXPECT_EQ(marked("v(?x, ?y) + 1.0"), 0);
    EXPECT_EQ(marked("exp[v(?y, ?x)]"), 0);
}

// Three objects do not fill a register.
TEST(EvaluateTogether, TakesFewObjectsWhoseRealsTakeLong) {
    const auto marked = [](const std::string& cpf) {
        passes::Report report;
        passes::evaluate_together(
            grounded({.pvariables = "C(obj, obj) : { non-fluent, real, default = 1.0 };\n"
                                    "v(obj) : { state-fluent, real, default = 0.0 };",
                      .cpfs = "v'(?x) = " + cpf + ";"}),
            report);
        return report["loops over several objects at once"];
    };
    EXPECT_EQ(marked("exp[v(?x)]"), 1);
    EXPECT_EQ(marked("if (v(?x) > 1.0) then 2.0 else v(?x) + Normal(0.0, 1.0)"), 1);
    EXPECT_EQ(marked("max[0.0, min[v(?x), 1.0]] + v(?x) * v(?x) / 3.0"), 0);
    EXPECT_EQ(marked("v(?x) + sum_{?y : obj} [v(?y)]"), 0);
    EXPECT_EQ(marked("exp[sum_{?y : obj} [C(?x, ?y) * v(?y)]]"), 1);
}

// Six pairs do, in place of six jumps, unless they wait for what this step has stored.
TEST(EvaluateTogether, TakesFewRealsThatJump) {
    const auto marked = [](const std::string& cpf) {
        passes::Report report;
        passes::evaluate_together(
            grounded({.pvariables = "w(pair, obj) : { interm-fluent, real };\n"
                                    "v(pair, obj) : { state-fluent, real, default = 0.0 };\n"
                                    "k(pair, obj) : { state-fluent, int, default = 0 };",
                      .cpfs = "w(?p, ?x) = v(?p, ?x);\nk'(?p, ?x) = if (k(?p, ?x) > 1) then 0 else "
                              "k(?p, ?x) * k(?p, ?x) + k(?p, ?x) * 2;\nv'(?p, ?x) = " +
                              cpf + ";"}),
            report);
        return report["loops over several objects at once"];
    };
    const auto jumping = [](const std::string& value) {
        return "if (v(?p, ?x) > 1.0) then 0.0 else " + value + " * " + value + " + " + value +
               " * v(?p, ?x)";
    };
    EXPECT_EQ(marked(jumping("v(?p, ?x)")), 1);
    EXPECT_EQ(marked(jumping("w(?p, ?x)")), 0);
    EXPECT_EQ(marked("if (v(?p, ?x) > 1.0) then 0.0 else v(?p, ?x) + 1.0"), 0);
}

// An exponential would wait for reals of six pairs that were stored one by one, and so would these.
TEST(EvaluateTogether, TakesFewRealsThatRegistersRead) {
    const auto marked = [](const std::string& cpf_of_u) {
        passes::Report report;
        passes::evaluate_together(
            grounded({.pvariables = "u(pair, obj) : { state-fluent, real, default = 0.0 };\n"
                                    "v(pair, obj) : { state-fluent, real, default = 0.0 };\n"
                                    "w(pair, obj) : { state-fluent, real, default = 0.0 };",
                      .cpfs = "u'(?p, ?x) = " + cpf_of_u +
                              ";\nv'(?p, ?x) = v(?p, ?x) * 0.5 + 0.1 * w(?p, ?x);\n"
                              "w'(?p, ?x) = w(?p, ?x) * w(?p, ?x) - w(?p, ?x) * 0.5;"}),
            report);
        return report["loops over several objects at once"];
    };
    EXPECT_EQ(marked("u(?p, ?x)"), 0);
    EXPECT_EQ(marked("exp[u(?p, ?x)]"), 1);
    EXPECT_EQ(marked("exp[v(?p, ?x)]"), 3);
}

TEST(EvaluateTogether, TakesFewObjectsThatDrawByThresholds) {
    const auto marked = [](const std::string& cpf) {
        passes::Report report;
        const ir::Program program =
            grounded({.pvariables = "c : { state-fluent, bool, default = false };\n"
                                    "hue(obj) : { interm-fluent, color };",
                      .cpfs = "c' = ~c;\nhue(?x) = " + cpf + ";"});
        passes::evaluate_together(passes::tabulate_thresholds(program, report), report);
        return report["loops over several objects at once"];
    };
    const std::string draw = "Discrete(color, @red : 0.25, @green : 0.5, @blue : 0.25)";
    EXPECT_EQ(marked(draw), 1);
    EXPECT_EQ(marked("if (c) then @red else " + draw), 1);
    EXPECT_EQ(marked("if (c) then @red else if (c) then @blue else " + draw), 0);
}

// Both objects draw from the weights of three others.
TEST(EvaluateTogether, TakesDrawsFromWeightsThatLieBesideEachOther) {
    const auto is_marked = [](const std::string& weight) {
        passes::Report report;
        const ir::Program program = valid(passes::evaluate_together(
            grounded({.pvariables = "w(obj, pair) : { state-fluent, real, default = 0.2 };\n"
                                    "u(pair, obj) : { state-fluent, bool, default = false };\n"
                                    "at(pair) : { interm-fluent, obj };",
                      .cpfs = "w'(?x, ?p) = w(?x, ?p);\nu'(?p, ?x) = u(?p, ?x);\n"
                              "at(?p) = UnnormDiscrete_{?x : obj} (" +
                              weight + ");"}),
            report));
        return ir::print(program).find("for p in pair, several at once") != std::string::npos;
    };
    EXPECT_TRUE(is_marked("exp[w(?x, ?p)]"));
    EXPECT_FALSE(is_marked("w(?x, ?p)")) << "cheap";
    EXPECT_FALSE(is_marked("exp[w(?x, ?p) + u(?p, ?x)]")) << "bools apart";
}

// The first dimension of `at` has one object.
TEST(EvaluateTogether, PassesOverAxesOfASingleObject) {
    std::string text = Problem{.pvariables =
                                   "at(pair, obj, obj) : { state-fluent, bool, default = false };\n"
                                   "to(obj, pair, obj) : { state-fluent, bool, default = false };\n"
                                   "a : { action-fluent, bool, default = false };",
                               .cpfs =
                                   "at'(?p, ?x, ?y) = at(?p, ?x, ?y) ^ a;\n"
                                   "to'(?x, ?p, ?y) = to(?x, ?p, ?y) ^ a;"}
                           .text();
    text.replace(text.find("{a1, a2}"), 8, "{a1}");
    passes::Report report;
    const std::string after =
        ir::print(valid(passes::evaluate_together(std::move(*ground_text(text).program), report)));
    EXPECT_NE(after.find("for x in obj, as words\n        for y in obj\n"
                         "            next.at[0, x, y] = "),
              std::string::npos)
        << after;
    EXPECT_EQ(report["loops over several objects at once"], 1) << after;
}

TEST(EvaluateTogether, LeavesLoopsThatReadOtherElements) {
    for (const char* cpf :
         {"on(?y, ?x) ^ a", "Bernoulli(W(?x))", "w(?y)", "exists_{?z : obj} [on(?x, ?z)]",
          "forall_{?z : obj} [Bernoulli(P(?x, ?z))]", "Poisson(2.0) > 3", "?x == ?y"})
        EXPECT_EQ(loop_for(cpf), "for x in obj") << cpf;
}

// The loop over 27 triples; the CPF of `t` of a triple is given.
std::string loop_over_triples(const std::string& cpf_of_t, const std::string& type) {
    const Problem problem = {
        .pvariables =
            "C(obj, obj, obj) : { non-fluent, real, default = 0.5 };\n"
            "u(obj, obj, obj, obj) : { state-fluent, bool, default = false };\n"
            "r(obj, obj, obj, obj) : { state-fluent, real, default = 0.0 };\n"
            "t(obj, obj, obj) : { interm-fluent, " +
            type + " };",
        .cpfs = "t(?x, ?y, ?z) = " + cpf_of_t +
                ";\nu'(?w, ?x, ?y, ?z) = u(?w, ?x, ?y, ?z);\n"
                "r'(?w, ?x, ?y, ?z) = r(?w, ?x, ?y, ?z);",
        .non_fluents = "C(b1, b2, b2) = 0.25;"};
    passes::Report report;
    const std::string text = ir::print(valid(passes::evaluate_together(grounded(problem), report)));
    const std::size_t store = text.find("scratch.t[");
    const std::size_t begin = text.rfind("for x in obj", store), end = text.find("\n", begin);
    return text.substr(begin, end - begin);
}

TEST(EvaluateTogether, TakesAggregationsOfElementsThatLieBesideEachOther) {
    EXPECT_EQ(loop_over_triples("exists_{?w : obj} [u(?w, ?x, ?y, ?z)]", "bool"),
              "for x in obj, several at once");
    EXPECT_EQ(loop_over_triples("sum_{?w : obj} [u(?w, ?x, ?y, ?z)]", "int"),
              "for x in obj, several at once");
    EXPECT_EQ(loop_over_triples("min_{?w : obj} [r(?w, ?x, ?y, ?z) * C(?x, ?y, ?z)]", "real"),
              "for x in obj, several at once");
}

// Registers transpose rows that fill them.
TEST(EvaluateTogether, TakesSumsOfOwnRows) {
    const auto loop_with = [](const std::string& objects, const std::string& sum) {
        std::string text = with_pairs("~on(?x, ?y)").text();
        const std::string three = "obj : {b1, b2, b3}", cpf = "w'(?x) = ~w(?x);";
        text.replace(text.find(three), three.size(), "obj : {" + objects + "}");
        text.replace(text.find(cpf), cpf.size(), "w'(?x) = " + sum + " > 1.0;");
        Grounded result = ground_text(text);
        if (!result.program) return result.messages;
        passes::Report report;
        const std::string step =
            step_text(valid(passes::evaluate_together(std::move(*result.program), report)));
        const std::size_t begin = step.rfind("for x in obj", step.find("next.w["));
        return step.substr(begin, step.find('\n', begin) - begin);
    };
    const std::string eight = "b1, b2, b3, b4, b5, b6, b7, b8";
    EXPECT_EQ(loop_with(eight, "(sum_{?y : obj} [v(?x, ?y)])"), "for x in obj, several at once");
    EXPECT_EQ(loop_with(eight, "(sum_{?y : obj} [2.0 * v(?x, ?y)])"), "for x in obj");
    EXPECT_EQ(loop_with(eight, "(prod_{?y : obj} [v(?x, ?y)])"), "for x in obj");
    EXPECT_EQ(loop_with(eight + ", b9", "(sum_{?y : obj} [v(?x, ?y)])"), "for x in obj");
}

TEST(EvaluateTogether, TakesIntsThatAreMadeFromReals) {
    EXPECT_EQ(loop_over_triples("sgn[C(?x, ?y, ?z) * C(?x, ?y, ?z) - 0.25]", "int"),
              "for x in obj, several at once");
    EXPECT_EQ(loop_over_triples("sgn[C(?x, ?y, ?z)]", "int"), "for x in obj");
}

TEST(EvaluateTogether, LeavesOtherAggregations) {
    for (const char* cpf :
         {"exists_{?w : obj} [u(?x, ?y, ?z, ?w)]", "exists_{?w : obj} [u(?x, ?w, ?y, ?z)]",
          "exists_{?w : obj} [u(?w, ?x, ?z, ?y)]", "exists_{?w : obj} [?w == ?x]",
          "forall_{?w : obj} [Bernoulli(0.5) | u(?w, ?x, ?y, ?z)]"})
        EXPECT_EQ(loop_over_triples(cpf, "bool"), "for x in obj") << cpf;
    EXPECT_EQ(loop_over_triples("sum_{?w : obj} [r(?x, ?y, ?z, ?w) * 2.0]", "real"),
              "for x in obj");
    EXPECT_EQ(loop_over_triples("argmax_{?w : obj} [r(?w, ?x, ?y, ?z)]", "obj"), "for x in obj");
}

TEST(EvaluateTogether, LeavesCheapSumsAndShortLoops) {
    passes::Report report;
    const std::string text =
        ir::print(passes::evaluate_together(grounded(with_pairs("on(?x, ?y)")), report));
    EXPECT_EQ(report["loops over several objects at once"], 1) << text;
}

// A register would wait for the counts that the step before has stored one by one.
TEST(EvaluateTogether, LeavesBoolsOfFewObjectsThatCompareNewCounts) {
    const auto loop_of_full = [](const std::string& second_type, const std::string& cpf_of_full) {
        Problem problem = with_pairs("on(?x, ?y)");
        problem.pvariables += "\nk(obj, " + second_type +
                              ") : { state-fluent, int, default = 0 };\nfull(obj, " + second_type +
                              ") : { state-fluent, bool, default = false };";
        problem.cpfs +=
            "\nk'(?x, ?z) = if (full(?x, ?z)) then k(?x, ?z) * 3 else k(?x, ?z) + 2;\n"
            "full'(?x, ?z) = " +
            cpf_of_full + ";";
        passes::Report report;
        const std::string text =
            ir::print(valid(passes::evaluate_together(grounded(problem), report)));
        const std::size_t begin = text.rfind("for x in obj", text.find("next.full"));
        return text.substr(begin, text.find("\n", begin) - begin);
    };
    EXPECT_EQ(loop_of_full("pair", "full(?x, ?z) | k(?x, ?z) == 4"), "for x in obj");
    EXPECT_EQ(loop_of_full("pair", "Bernoulli(0.5) ^ k(?x, ?z) == 4"),
              "for x in obj, several at once");
    EXPECT_EQ(loop_of_full("obj", "full(?x, ?z) | k(?x, ?z) == 4"),
              "for x in obj, several at once");
}

}  // namespace
}  // namespace rddlc
