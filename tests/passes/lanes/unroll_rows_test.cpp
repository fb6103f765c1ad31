#include "passes/lanes/unroll_rows.hpp"

#include "passes/aggregations/make_aggregations_sparse.hpp"
#include "texts.hpp"

#include <string>

namespace rddlc {
namespace {

Problem with_linked_rows(const std::string& cpf_of_depth) {
    return {.pvariables =
                "LINK(obj, obj) : { non-fluent, bool, default = false };\n"
                "SHARE(obj, obj) : { non-fluent, real, default = 0.5 };\n"
                "depth(obj) : { state-fluent, real, default = 1.0 };\n"
                "n(obj) : { state-fluent, int, default = 2 };\n"
                "shift : { state-fluent, real, default = 0.0 };",
            .cpfs = "depth'(?x) = " + cpf_of_depth + ";\nn'(?x) = n(?x);\nshift' = shift;",
            .non_fluents = "LINK(b1, b2); LINK(b1, b3); LINK(b3, b1); SHARE(b1, b3) = 0.25;"};
}

std::string unrolled(const Problem& problem, passes::Report& report) {
    ir::Program program = passes::make_aggregations_sparse(of_moderate_values(problem), report);
    report.clear();
    return step_text(valid(passes::unroll_rows(std::move(program), report)));
}
std::string unrolled(const std::string& cpf_of_depth) {
    passes::Report report;
    return unrolled(with_linked_rows(cpf_of_depth), report);
}

const std::string inflow = "(sum_{?y : obj} [LINK(?x, ?y) * SHARE(?x, ?y) * depth(?y)])";

TEST(UnrollRows, WritesTheTermsOfEachElement) {
    EXPECT_EQ(unrolled(inflow),
              "next.depth[0] = 0.0 + (0.5 * state.depth[1] + 0.25 * state.depth[2])\n"
              "next.depth[1] = 0.0\n"
              "next.depth[2] = 0.0 + 0.5 * state.depth[0]\n"
              "for x in obj\n"
              "    next.n[x] = state.n[x]\n"
              "next.shift = state.shift\n");
}

TEST(UnrollRows, TakesAFewOperationsBesideTheSum) {
    EXPECT_EQ(unrolled(inflow + " - shift"),
              "next.depth[0] = 0.0 + (0.5 * state.depth[1] + 0.25 * state.depth[2] - state.shift)\n"
              "next.depth[1] = 0.0 - state.shift\n"
              "next.depth[2] = 0.0 + (0.5 * state.depth[0] - state.shift)\n"
              "for x in obj\n"
              "    next.n[x] = state.n[x]\n"
              "next.shift = state.shift\n");
}

TEST(UnrollRows, RunsOverAllObjectsOfNestedLoops) {
    Problem problem = with_linked_rows("depth(?x)");
    problem.pvariables += "\nflow(obj, obj) : { interm-fluent, real };";
    problem.cpfs += "\nflow(?x, ?z) = " + inflow + " + depth(?z);";
    passes::Report report;
    const std::string step = unrolled(problem, report);
    EXPECT_NE(step.find("scratch.flow[0, 2] = 0.0 + (0.5 * state.depth[1] + 0.25 * "
                        "state.depth[2] + state.depth[2])\n"
                        "scratch.flow[1, 0] = 0.0 + state.depth[0]\n"),
              std::string::npos)
        << step;
}

TEST(UnrollRows, LeavesLoopsThatDoMore) {
    for (const std::string& cpf :
         {std::string("depth(?x)"), "exp[" + inflow + "]", inflow + " + Normal(0, 1)",
          "if (depth(?x) > 1.0) then " + inflow + " else 0.0",
          std::string("sum_{?y : obj} [depth(?y) * depth(?x)]")}) {
        passes::Report report;
        unrolled(with_linked_rows(cpf), report);
        EXPECT_TRUE(report.empty()) << cpf;
    }
}

TEST(UnrollRows, LeavesLargeTables) {
    Problem problem = with_linked_rows("depth(?x)");
    problem.pvariables += "\nflow(obj, obj, obj, obj, obj, obj) : { interm-fluent, real };";
    problem.cpfs += "\nflow(?x, ?a, ?b, ?c, ?d, ?e) = " + inflow + ";";
    passes::Report report;
    unrolled(problem, report);
    EXPECT_TRUE(report.empty());
}

// A site belongs to one node.
TEST(UnrollRows, LeavesWhatDrawsOrMayFault) {
    for (const char* cpf : {"sum_{?y : obj} [LINK(?x, ?y) * pow[2, n(?y)]]",
                            "sum_{?y : obj} [LINK(?x, ?y) * lngamma[depth(?y)]]",
                            "sum_{?y : obj} [LINK(?x, ?y) * Bernoulli(0.5)]"}) {
        const Problem problem = with_linked_rows(cpf);
        passes::Report report;
        EXPECT_EQ(unrolled(problem, report).find("next.depth[0]"), std::string::npos);
        EXPECT_EQ(report["loops over rows unrolled"], 0);
    }
}

}  // namespace
}  // namespace rddlc
