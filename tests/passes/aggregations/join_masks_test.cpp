#include "passes/aggregations/join_masks.hpp"

#include "passes/aggregations/index_directly.hpp"
#include "texts.hpp"

#include <algorithm>

namespace rddlc {
namespace {

// Things on a road of 20 places: red leads to the next place, and green to the one before; the ends
// lead to themselves, so that two places lead there.
Problem road(const std::string& parameters, const std::string& cpfs, const std::string& places) {
    Problem problem{.pvariables =
                        "LEADS(color, obj, obj) : { non-fluent, bool, default = false };\n"
                        "at(" +
                        parameters +
                        ") : { state-fluent, bool, default = false };\n"
                        "free(obj) : { state-fluent, bool, default = true };\n"
                        "works(pair) : { state-fluent, bool, default = true };\n"
                        "go(pair) : { action-fluent, color, default = @blue };\n"
                        "turn(obj) : { action-fluent, color, default = @blue };",
                    .cpfs = cpfs + "\nfree'(?o) = free(?o);\nworks'(?a) = works(?a);",
                    .init_state = places};
    for (int i = 1; i <= 20; ++i) {
        const std::string here = "b" + std::to_string(i);
        problem.non_fluents +=
            "LEADS(@red, " + here + ", b" + std::to_string(std::min(i + 1, 20)) + "); ";
        problem.non_fluents +=
            "LEADS(@green, " + here + ", b" + std::to_string(std::max(i - 1, 1)) + "); ";
    }
    return problem;
}

ir::Program without_colors(const Problem& problem) {
    passes::Report report;
    return passes::index_directly(grounded_with_many(problem), report);
}

std::string joined(const Problem& problem) {
    passes::Report report;
    const std::string step = step_text(valid(passes::join_masks(without_colors(problem), report)));
    return step.substr(0, step.find("for o in obj\n"));
}

TEST(JoinMasks, LooksUpWhatTheTrueElementsReach) {
    const Problem problem =
        road("obj, obj",
             "at'(?a, ?x) = exists_{?y : obj, ?c : color} [at(?a, ?y) ^ (turn(?a) == ?c) ^ "
             "LEADS(?c, ?y, ?x) ^ free(?a)];",
             "at(b1, b2); at(b2, b1);");
    EXPECT_EQ(joined(problem), R"(for a in obj
    spread next.at[a] = select(state.free[a], union[at-masks[action.turn[a]]](bits(state.at[a], 0)), 0)
)");
    passes::Report report;
    const ir::Program program = passes::join_masks(without_colors(problem), report);
    EXPECT_EQ(report["rows of bools that are looked up"], 1);
    // Red leads from b1 to b2, which has bit 1.
    EXPECT_TRUE(table_text(program, "at-masks").starts_with("at-masks[3, 20]: int = {2 4 8 "));
}

TEST(JoinMasks, HasTheBitsOfAFewRowsInOneInt) {
    EXPECT_EQ(joined(road("pair, obj",
                          "at'(?a, ?x) = exists_{?y : obj, ?c : color} [at(?a, ?y) ^ (go(?a) == "
                          "?c) ^ LEADS(?c, ?y, ?x) ^ works(?a)];",
                          "at(a1, b2); at(a2, b1);")),
              "spread next.at = bit_or("
              "select(state.works[0], union[at-masks[action.go[0]]](bit_and(bits(state.at, 0), "
              "1048575)), 0), "
              "select(state.works[1], union[at-masks[action.go[1]]](bit_and(bits(state.at, 0), "
              "1099510579200)), 0))\n");
}

TEST(JoinMasks, LeavesOthers) {
    const char* const places = "at(a1, b2); at(a2, b1);";
    for (const char* const body :
         {"at(?a, ?y) ^ LEADS(@red, ?y, ?x)",                         // nothing chooses
          "at(?a, ?y) ^ (forall_{?b : pair} LEADS(go(?b), ?y, ?x))",  // nor for all of a row
          "at(?a, ?y) ^ LEADS(go(?a), ?y, ?x) ^ free(?x)",            // the state decides
          "free(?y) ^ LEADS(go(?a), ?y, ?x)",                         // many are true
          "at(?a, ?y) ^ LEADS(go(?a), ?y, ?x) ^ Bernoulli(0.5)",      // a draw
          "at(?a, ?x) ^ LEADS(go(?a), ?y, ?x)"}) {                    // of no other place
        const ir::Program program = without_colors(road(
            "pair, obj", "at'(?a, ?x) = exists_{?y : obj} [" + std::string(body) + "];", places));
        passes::Report report;
        EXPECT_EQ(ir::print(passes::join_masks(program, report)), ir::print(program)) << body;
    }
    const Problem many =
        road("pair, obj", "at'(?a, ?x) = exists_{?y : obj} [at(?a, ?y) ^ LEADS(go(?a), ?y, ?x)];",
             "at(a1, b1); at(a1, b2); at(a1, b3); at(a2, b1); at(a2, b2); at(a2, b3);");
    passes::Report report;
    const ir::Program program = without_colors(many);
    EXPECT_EQ(ir::print(passes::join_masks(program, report)), ir::print(program));
}

}  // namespace
}  // namespace rddlc
