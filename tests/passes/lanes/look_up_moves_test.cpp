#include "passes/lanes/look_up_moves.hpp"

#include "passes/aggregations/index_directly.hpp"
#include "passes/lanes/choose_evaluation.hpp"
#include "passes/lanes/evaluate_together.hpp"
#include "passes/lanes/read_places.hpp"
#include "passes/lanes/visit_affected.hpp"
#include "passes/sharing/share_subexpressions.hpp"
#include "texts.hpp"

namespace rddlc {
namespace {

// A thing on a chain of 20 places.
ir::Program that_knows_affected(const std::string& cpf) {
    Problem problem{.pvariables =
                        "NEXT(obj, obj) : { non-fluent, bool, default = false };\n"
                        "P(obj) : { non-fluent, real, default = 0.5 };\n"
                        "at(obj) : { state-fluent, bool, default = false };\n"
                        "lost : { state-fluent, bool, default = false };\n"
                        "wet(obj) : { state-fluent, bool, default = false };\n"
                        "go : { action-fluent, bool, default = false };",
                    .cpfs = "at'(?o) = " + cpf + "; lost' = lost; wet'(?o) = wet(?o);",
                    .non_fluents = "P(b3) = 1; P(b4) = 0; ",
                    .init_state = "at(b2);"};
    for (int i = 1; i < 20; ++i)
        problem.non_fluents += "NEXT(b" + std::to_string(i) + ", b" + std::to_string(i + 1) + "); ";
    passes::Report report;
    ir::Program program = passes::index_directly(grounded_with_many(problem), report);
    program = passes::read_places(std::move(program), report);
    program = passes::share_subexpressions(std::move(program), report);
    program = passes::evaluate_together(std::move(program), report);
    program = passes::visit_affected(std::move(program), report);
    EXPECT_EQ(report["loops over the objects that few bools affect"], 1) << cpf;
    return passes::choose_evaluation(std::move(program), report);
}

TEST(LookUpMoves, SaysWhichBoolIsTrue) {
    passes::Report report;
    const ir::Program program = valid(passes::look_up_moves(
        that_knows_affected("if (go) then (if (exists_{?p : obj} [NEXT(?p, ?o) ^ at(?p)]) "
                            "then Bernoulli(P(?o)) else false) else at(?o)"),
        report));
    EXPECT_NE(step_text(program).find(", affected by state.at, moves at-moves[action.go]\n"),
              std::string::npos)
        << step_text(program);
    EXPECT_EQ(report["loops that look up where the only true bool goes"], 1);
    // The thing stays at b1 without the action; with it b2 has a draw, which is 20 more. That of b3
    // is certain, and that of b4 never is.
    const std::string table = table_text(program, "at-moves[");
    EXPECT_NE(table.find("= {0 21 1 2 2 40 3 24 4 25 "), std::string::npos) << table;
    const ir::Program again = passes::look_up_moves(program, report);
    EXPECT_EQ(ir::print(again), ir::print(program));
}

TEST(LookUpMoves, TakesBoolsOfTheState) {
    passes::Report report;
    const ir::Program program = valid(passes::look_up_moves(
        that_knows_affected("if (go ^ ~lost) then (if (exists_{?p : obj} [NEXT(?p, ?o) ^ at(?p)]) "
                            "then Bernoulli(P(?o)) else false) else at(?o)"),
        report));
    EXPECT_NE(step_text(program).find(", moves at-moves[action.go, state.lost]\n"),
              std::string::npos)
        << step_text(program);
    const std::string table = table_text(program, "at-moves[");
    EXPECT_NE(table.find("= {0 21 0 0 1 2 1 1 "), std::string::npos) << table;
}

TEST(LookUpMoves, FindsBoolsBehindNames) {
    passes::Report report;
    const ir::Program program = valid(passes::look_up_moves(
        that_knows_affected("if (go + 2 * lost + go * lost == 1) "
                            "then (if (exists_{?p : obj} [NEXT(?p, ?o) ^ at(?p)]) "
                            "then Bernoulli(P(?o)) else false) "
                            "else (at(?o) ^ go + 2 * lost + go * lost < 2)"),
        report));
    const std::string text = step_text(program);
    EXPECT_NE(text.find("let "), std::string::npos) << text;
    EXPECT_NE(text.find(", moves at-moves[action.go, state.lost]\n"), std::string::npos) << text;
}

TEST(LookUpMoves, LeavesOthers) {
    const std::string if_behind = "if (exists_{?p : obj} [NEXT(?p, ?o) ^ at(?p)]) then ";
    for (const std::string& cpf :
         {// Another table decides.
          "if (wet(?o)) then (" + if_behind + "Bernoulli(0.5) else false) else at(?o)",
          // Mostly there are two true bools afterwards.
          if_behind + "Bernoulli(0.5) else at(?o)",
          // Two draws; one that makes a bool false.
          "if (go) then (" + if_behind +
              "Bernoulli(0.5) else false) "
              "else (if (at(?o)) then Bernoulli(0.7) else false)",
          if_behind + "~Bernoulli(0.5) else false"}) {
        const ir::Program program = that_knows_affected(cpf);
        passes::Report report;
        EXPECT_EQ(ir::print(passes::look_up_moves(program, report)), ir::print(program));
    }
}

}  // namespace
}  // namespace rddlc
