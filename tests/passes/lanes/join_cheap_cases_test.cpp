#include "passes/lanes/join_cheap_cases.hpp"

#include "passes/lanes/evaluate_together.hpp"
#include "texts.hpp"

namespace rddlc {
namespace {

ir::Program looped_stock(const std::string& cpf) {
    passes::Report report;
    return passes::evaluate_together(
        grounded_with_many({.pvariables = "stock(obj) : { state-fluent, int, default = 0 };\n"
                                          "open(obj) : { state-fluent, bool, default = false };\n"
                                          "fill(obj) : { action-fluent, bool, default = false };",
                            .cpfs = "stock'(?o) = " + cpf + "; open'(?o) = fill(?o);"}),
        report);
}

TEST(JoinCheapCases, MakesThemOneBranch) {
    passes::Report report;
    const ir::Program program = valid(
        passes::join_cheap_cases(looped_stock("if (open(?o)) then 2 else if (fill(?o)) then 3 "
                                              "else if (Bernoulli(0.5)) then 4 else stock(?o)"),
                                 report));
    EXPECT_NE(step_text(program).find("next.stock[o] = select(state.open[o] || action.fill[o], "
                                      "select(state.open[o], 2, 3), "
                                      "select(sample bernoulli@0[o](0.5), 4, state.stock[o]))\n"),
              std::string::npos)
        << step_text(program);
    EXPECT_EQ(report["cheap cases that become one branch"], 1);
    EXPECT_EQ(ir::print(passes::join_cheap_cases(program, report)), ir::print(program));
}

TEST(JoinCheapCases, LeavesOthers) {
    for (const ir::Program& program :
         {looped_stock("if (open(?o)) then 2 else if (fill(?o)) then 3 else stock(?o)"),
          looped_stock("if (open(?o)) then 2 else if (Bernoulli(0.5)) then 4 else stock(?o)"),
          looped_stock("if (open(?o)) then Binomial(3, 0.5) else if (fill(?o)) then 3 "
                       "else if (Bernoulli(0.5)) then 4 else stock(?o)")}) {
        passes::Report report;
        EXPECT_EQ(ir::print(passes::join_cheap_cases(program, report)), ir::print(program));
    }
}

}  // namespace
}  // namespace rddlc
