#include "passes/lanes/draw_for_chosen.hpp"

#include "passes/lanes/evaluate_together.hpp"
#include "passes/lanes/test_cheap_first.hpp"
#include "texts.hpp"

namespace rddlc {
namespace {

// Tanks that an action fills.
ir::Program filling(const std::string& cpf, std::int64_t most_filled = 10) {
    ir::Program program =
        grounded_with_many({.pvariables = "stock(obj) : { state-fluent, int, default = 0 };\n"
                                          "chance(obj) : { state-fluent, real, default = 0.5 };\n"
                                          "fill(obj) : { action-fluent, bool, default = false };",
                            .cpfs = "stock'(?o) = " + cpf + "; chance'(?o) = chance(?o);"});
    for (ir::Buffer& buffer : program.buffers)
        if (buffer.storage == ir::Storage::Action) buffer.most_true = most_filled;
    passes::Report report;
    return passes::evaluate_together(passes::test_cheap_first(std::move(program), report), report);
}

constexpr const char* filled = "if (fill(?o) ^ Bernoulli(0.75)) then 2 else stock(?o)";

TEST(DrawForChosen, MakesDrawsBeforeTheLoop) {
    passes::Report report;
    const ir::Program program = valid(passes::draw_for_chosen(filling(filled), report));
    EXPECT_NE(step_text(program).find(
                  "for o in obj, several at once, chosen by action.fill, others false\n"
                  "    scratch.fill-draws[o] = select(action.fill[o], "
                  "sample bernoulli@0[o](0.75), false)\n"
                  "for o in obj, several at once\n"
                  "    next.stock[o] = select(scratch.fill-draws[o], 2, state.stock[o])\n"),
              std::string::npos)
        << step_text(program);
    EXPECT_EQ(report["draws made before a loop for the objects that an action chooses"], 1);
    EXPECT_EQ(ir::print(passes::draw_for_chosen(program, report)), ir::print(program));
}

TEST(DrawForChosen, LeavesOthers) {
    for (const ir::Program& program :
         {filling(filled, 11), filling("if (Bernoulli(0.75)) then 2 else stock(?o)"),
          filling("if (fill(?o) ^ Normal(0, 1) > 0.5) then 2 else stock(?o)"),
          // The action chooses where it may fault, but the loop does not always get there.
          filling("if (stock(?o) == 1) then 3 else "
                  "if (fill(?o) ^ Bernoulli(chance(?o))) then 2 else stock(?o)")}) {
        passes::Report report;
        EXPECT_EQ(ir::print(passes::draw_for_chosen(program, report)), ir::print(program));
    }
}

}  // namespace
}  // namespace rddlc
