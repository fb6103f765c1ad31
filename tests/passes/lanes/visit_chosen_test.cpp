#include "passes/lanes/visit_chosen.hpp"

#include "passes/lanes/evaluate_together.hpp"
#include "texts.hpp"

namespace rddlc {
namespace {

// Courses that an action takes.
ir::Program in_loops(const std::string& cpf, std::int64_t most_taken = 2) {
    passes::Report report;
    ir::Program program = passes::evaluate_together(
        grounded_with_many(
            {.pvariables = "passed(obj) : { state-fluent, bool, default = false };\n"
                           "open(obj) : { state-fluent, bool, default = true };\n"
                           "skill(obj) : { state-fluent, real, default = 0.5 };\n"
                           "take(obj) : { action-fluent, bool, default = false };",
             .cpfs = "passed'(?o) = " + cpf + "; open'(?o) = open(?o); skill'(?o) = skill(?o);"}),
        report);
    for (ir::Buffer& buffer : program.buffers)
        if (buffer.storage == ir::Storage::Action) buffer.most_true = most_taken;
    return program;
}

constexpr const char* passed =
    "if (take(?o) ^ ~passed(?o)) then Bernoulli(skill(?o)) else passed(?o)";

TEST(VisitChosen, SaysWhichBoolsObjectsKeep) {
    passes::Report report;
    const ir::Program program = valid(passes::visit_chosen(in_loops(passed), report));
    EXPECT_NE(step_text(program).find("for o in obj, several at once, chosen by action.take, "
                                      "others state.passed\n"),
              std::string::npos)
        << step_text(program);
    EXPECT_EQ(report["loops over the objects that an action chooses"], 1);
    EXPECT_EQ(ir::print(passes::visit_chosen(program, report)), ir::print(program));
}

TEST(VisitChosen, LeavesOthers) {
    for (const ir::Program& program :
         {in_loops(passed, 5),
          in_loops("if (take(?o)) then Bernoulli(skill(?o)) else (passed(?o) | open(?o))"),
          in_loops("if (take(?o)) then passed(?o) else Bernoulli(skill(?o))"),
          in_loops("if (take(?o)) then Normal(0, skill(?o)) > 0 else passed(?o)"),
          in_loops("if (take(?o)) then (Discrete_{?p : obj} [skill(?o)]) == ?o else passed(?o)"),
          in_loops("if (take(?o)) then skill(?o) > 0.3 else passed(?o)"),
          in_loops("if (take(?o)) then Bernoulli(0.5) else passed(?o)")}) {
        passes::Report report;
        EXPECT_EQ(ir::print(passes::visit_chosen(program, report)), ir::print(program));
    }
}

}  // namespace
}  // namespace rddlc
