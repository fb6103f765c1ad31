#include "passes/lanes/visit_affected.hpp"

#include "passes/aggregations/index_directly.hpp"
#include "passes/lanes/evaluate_together.hpp"
#include "passes/lanes/read_places.hpp"
#include "texts.hpp"

namespace rddlc {
namespace {

// A thing on a chain of 20 places.
ir::Program in_words(const std::string& cpf, const std::string& places = "at(b2);") {
    Problem problem{.pvariables =
                        "NEXT(obj, obj) : { non-fluent, bool, default = false };\n"
                        "at(obj) : { state-fluent, bool, default = false };\n"
                        "go : { action-fluent, bool, default = false };",
                    .cpfs = "at'(?o) = " + cpf + ";",
                    .init_state = places};
    for (int i = 1; i < 20; ++i)
        problem.non_fluents += "NEXT(b" + std::to_string(i) + ", b" + std::to_string(i + 1) + "); ";
    passes::Report report;
    ir::Program program = passes::index_directly(grounded_with_many(problem), report);
    program = passes::read_places(std::move(program), report);
    return passes::evaluate_together(std::move(program), report);
}

constexpr const char* moved =
    "if (go) then (if (exists_{?p : obj} [NEXT(?p, ?o) ^ at(?p)]) then Bernoulli(0.5) else false) "
    "else at(?o)";

TEST(VisitAffected, ListsTheObjectsThatReadEachBool) {
    passes::Report report;
    const ir::Program program = valid(passes::visit_affected(in_words(moved), report));
    EXPECT_NE(step_text(program).find("for o in obj, as words, affected by state.at\n"),
              std::string::npos)
        << step_text(program);
    EXPECT_EQ(report["loops over the objects that few bools affect"], 1);
    // The objects of b1 to b4 are b1 and b2, b2 and b3, ...; objects that read none read b1
    // (index_directly).
    EXPECT_TRUE(table_text(program, "at-affects[").find("= {0 1 1 2 2 3 3 4 ") != std::string::npos)
        << table_text(program, "at-affects[");
    const ir::Program again = passes::visit_affected(program, report);
    EXPECT_EQ(ir::print(again), ir::print(program));
}

// A conjunction with a draw is false without its first part, as a branch is.
TEST(VisitAffected, ReadsConjunctionsAsBranches) {
    passes::Report report;
    passes::visit_affected(
        in_words("if (go) then (exists_{?p : obj} [NEXT(?p, ?o) ^ at(?p)]) ^ Bernoulli(0.5) "
                 "else at(?o)"),
        report);
    EXPECT_EQ(report["loops over the objects that few bools affect"], 1);
}

TEST(VisitAffected, LeavesOthers) {
    for (const ir::Program& program :
         {in_words("if (go) then ~(exists_{?p : obj} [NEXT(?p, ?o) ^ at(?p)]) else at(?o)"),
          in_words("if (go) then Bernoulli(0.5) else at(?o)"),
          in_words(moved, "at(b2); at(b3);")}) {
        passes::Report report;
        EXPECT_EQ(ir::print(passes::visit_affected(program, report)), ir::print(program));
    }
}

}  // namespace
}  // namespace rddlc
