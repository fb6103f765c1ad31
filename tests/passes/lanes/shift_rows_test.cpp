#include "passes/lanes/shift_rows.hpp"

#include "passes/lanes/evaluate_together.hpp"
#include "texts.hpp"

namespace rddlc {
namespace {

constexpr const char* placed_term = "(if (NUMBER(?o) == due) then 0.5 * put else 0.0)";
constexpr const char* moved_item = "(if (IS-THERE(?o)) then item(AFTER(?o)) else 0.0)";

// Twenty elements that move to the front, with others that read them.
Problem with_moving(const std::string& item, const std::string& others = "taken' = item(B3);",
                    const std::string& changes = "") {
    Problem problem{.pvariables =
                        "IS-THERE(obj) : { non-fluent, bool, default = true };\n"
                        "AFTER(obj) : { non-fluent, obj };\n"
                        "B3 : { non-fluent, obj };\n"
                        "NUMBER(obj) : { non-fluent, int, default = 0 };\n"
                        "item(obj) : { state-fluent, real, default = 0.0 };\n"
                        "taken : { state-fluent, real, default = 0.0 };\n"
                        "due : { state-fluent, int, default = 5 };\n"
                        "put : { action-fluent, real, default = 0.0 };",
                    .cpfs = "item'(?o) = " + item + ";\n" + others + "\ndue' = due;",
                    .non_fluents = "IS-THERE(b20) = false; B3 = @b3; "};
    for (int i = 1; i <= 20; ++i) {
        const std::string object = "b" + std::to_string(i);
        const auto add = [&](const std::string& value) {
            const std::string name = value.substr(0, value.find(' '));
            if (changes.find(name + " ") == changes.npos) problem.non_fluents += value + "; ";
        };
        add("NUMBER(" + object + ") = " + std::to_string(i + 2));
        add("AFTER(" + object + ") = @b" + std::to_string(i % 20 + 1));
    }
    problem.non_fluents += changes;
    return problem;
}

std::string shifted(const Problem& problem) {
    ir::Program whole = grounded_with_many(problem);
    if (!whole.moderate) return "";
    passes::Report report;
    ir::Program program = valid(passes::shift_rows(std::move(**whole.moderate), report));
    EXPECT_EQ(ir::print(passes::shift_rows(program, report)), ir::print(program));
    return step_text(valid(passes::evaluate_together(std::move(program), report)));
}
bool has_shift(const Problem& problem) {
    return shifted(problem).find(", shifts\n") != std::string::npos;
}

TEST(ShiftRows, MarksTheLoopAndMovesItToTheEnd) {
    EXPECT_EQ(shifted(with_moving(std::string("0.0 + (") + placed_term + " + " + moved_item + ")")),
              "next.due = state.due\n"
              "next.taken = state.item[2]\n"
              "for o in obj, shifts\n"
              "    next.item[o] = 0.0 + (select(NUMBER[o] == state.due, 0.5 * action.put, 0.0) + "
              "select(IS-THERE[o], state.item[AFTER[o]], 0.0))\n");
}

TEST(ShiftRows, TakesSeveralTermsInTheirOrder) {
    EXPECT_TRUE(has_shift(with_moving(std::string("0.0 + (") + placed_term +
                                      " + (if (due + 1 == NUMBER(?o)) then taken else 0.0) + " +
                                      moved_item + ")")));
}

TEST(ShiftRows, LeavesOthers) {
    const std::string sum = std::string(placed_term) + " + " + moved_item;
    EXPECT_TRUE(has_shift(with_moving("0.0 + (" + sum + ")")));
    EXPECT_FALSE(has_shift(with_moving(sum))) << "zeros keep their signs";
    EXPECT_FALSE(
        has_shift(with_moving("0.0 + (" + std::string(moved_item) + " + " + placed_term + ")")));
    EXPECT_FALSE(has_shift(with_moving("0.0 + (item(?o) + " + sum + ")")));
    EXPECT_FALSE(has_shift(with_moving("0.0 + (" + sum + ")", "taken' = item'(B3);")))
        << "it is read";
    EXPECT_FALSE(has_shift(with_moving("0.0 + ((if (NUMBER(?o) == due) then item(B3) else 0.0) + " +
                                       std::string(moved_item) + ")")))
        << "it reads what is lost";
    EXPECT_FALSE(
        has_shift(with_moving("0.0 + (" + sum + ")", "taken' = 0.0;", "AFTER(b7) = @b6;")));
    EXPECT_FALSE(has_shift(with_moving("0.0 + (" + sum + ")", "taken' = 0.0;", "NUMBER(b7) = 1;")));
    EXPECT_FALSE(
        has_shift(with_moving("0.0 + (" + sum + ")", "taken' = 0.0;", "IS-THERE(b7) = false;")));
}

}  // namespace
}  // namespace rddlc
