#include "passes/aggregations/visit_true.hpp"

#include "ir/analysis.hpp"
#include "ir/visits.hpp"
#include "texts.hpp"

namespace rddlc {
namespace {

// A vehicle among 20 places that form a chain, and bools for all pairs of them.
Problem chain(const std::string& cpfs) {
    Problem problem{.pvariables =
                        "NEXT(obj, obj) : { non-fluent, bool, default = false };\n"
                        "at(obj) : { state-fluent, bool, default = false };\n"
                        "moved : { state-fluent, bool, default = false };\n"
                        "free(obj) : { state-fluent, bool, default = true };\n"
                        "move(obj, obj) : { action-fluent, bool, default = false };",
                    .cpfs = cpfs + "\nfree'(?o) = free(?o);",
                    .init_state = "at(b2);"};
    for (int i = 1; i < 20; ++i)
        problem.non_fluents += "NEXT(b" + std::to_string(i) + ", b" + std::to_string(i + 1) + "); ";
    return problem;
}

TEST(VisitTrue, VisitsTheRowsOfThoseThatAreTrue) {
    passes::Report report;
    const ir::Program program = valid(passes::visit_true(
        grounded_with_many(chain(
            "moved' = exists_{?o : obj, ?p : obj} [move(?o, ?p) ^ at(?o) ^ NEXT(?o, ?p) ^ "
            "~moved];\n"
            "at'(?o) = if (exists_{?p : obj} [move(?p, ?o) ^ at(?p) ^ NEXT(?p, ?o)]) then true\n"
            "    else at(?o) ^ ~exists_{?p : obj} [move(?o, ?p) ^ at(?o) ^ NEXT(?o, ?p)];")),
        report));
    EXPECT_EQ(step_text(program), R"(for o in obj
    next.at[o] = state.at[o]
scratch.moved-any = false
for true state.at[o]
    for entry in NEXT-rows[o] .. NEXT-rows[o + 1]
        next.at[o] = false where action.move[o, NEXT-p[entry]]
        scratch.moved-any = true where !state.moved && action.move[o, NEXT-p[entry]]
for true state.at[p]
    for entry in NEXT-rows[p] .. NEXT-rows[p + 1]
        next.at[NEXT-p[entry]] = true where action.move[p, NEXT-p[entry]]
for o in obj
    next.free[o] = state.free[o]
next.moved = scratch.moved-any
)");
    EXPECT_EQ(report["aggregations over the few that are true"], 1);
    EXPECT_EQ(report["tables marked where few are true"], 1);
}

// A road that leads to where it begins would make a vehicle leave and stay, in this order alone.
TEST(VisitTrue, TakesTurnsUnlessAnEntryIsItsObject) {
    for (const bool has_loop : {false, true}) {
        Problem problem = chain(
            "moved' = exists_{?o : obj, ?p : obj} [move(?o, ?p) ^ at(?o) ^ NEXT(?o, ?p) ^ "
            "~moved];\n"
            "at'(?o) = if (exists_{?p : obj} [move(?p, ?o) ^ at(?p) ^ NEXT(?p, ?o)]) then true\n"
            "    else at(?o) ^ ~exists_{?p : obj} [move(?o, ?p) ^ at(?o) ^ NEXT(?o, ?p)];");
        if (has_loop) problem.non_fluents += "NEXT(b7, b7);";
        passes::Report report;
        const ir::Program program = passes::visit_true(grounded_with_many(problem), report);
        std::vector<ir::Visit> visits;
        for (const ir::Block* block : ir::blocks_of(program))
            ir::for_each_statement<ir::Visit>(
                *block, [&](const ir::Visit& visit) { visits.push_back(visit); });
        ASSERT_EQ(visits.size(), 2);
        EXPECT_EQ(ir::may_take_turns(program, visits[0], visits[1]), !has_loop);
    }
}

TEST(VisitTrue, LeavesOthers) {
    for (const char* const body : {"move(?o, ?p) ^ free(?o) ^ NEXT(?o, ?p)",  // many are true
                                   "free(?p) ^ at(?o) ^ NEXT(?o, ?p)",  // words hold what is read
                                   "move(?o, ?p) ^ at(?o)",             // no constant chooses pairs
                                   "move(?o, ?p) ^ at(?o) ^ NEXT(?o, ?p) ^ Bernoulli(0.5)"}) {
        const ir::Program program =
            grounded_with_many(chain("moved' = exists_{?o : obj, ?p : obj} [" + std::string(body) +
                                     "];\nat'(?o) = at(?o);"));
        passes::Report report;
        EXPECT_EQ(ir::print(passes::visit_true(program, report)), ir::print(program)) << body;
    }
}

}  // namespace
}  // namespace rddlc
