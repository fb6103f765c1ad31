#include "passes/lanes/narrow_objects.hpp"

#include "passes/lanes/read_places.hpp"
#include "texts.hpp"

#include <string>
#include <vector>

namespace rddlc {
namespace {

// Three by three cells. FIRST is true in column b1, HIGH in rows b2 and b3; the column
// before the first one is the last one, and the one to its left is itself.
Problem of_cells(const std::string& cpf_of_on) {
    return {.pvariables =
                "FIRST(obj) : { non-fluent, bool, default = false };\n"
                "HIGH(obj) : { non-fluent, bool, default = false };\n"
                "NOT-FIRST(obj) : { non-fluent, bool, default = true };\n"
                "BEFORE(obj) : { non-fluent, obj };\n"
                "LEFT(obj) : { non-fluent, obj };\n"
                "on(obj, obj) : { state-fluent, bool, default = false };\n"
                "v(obj) : { state-fluent, int, default = 1 };\n"
                "a(obj) : { action-fluent, bool, default = false };",
            .cpfs = "on'(?x, ?y) = " + cpf_of_on + ";\nv'(?x) = v(?x);",
            .non_fluents =
                "FIRST(b1); NOT-FIRST(b1) = false; HIGH(b2); HIGH(b3);"
                "BEFORE(b1) = b3; BEFORE(b2) = b1; BEFORE(b3) = b2;"
                "LEFT(b1) = b1; LEFT(b2) = b1; LEFT(b3) = b2;"};
}

ir::Program narrowed(const std::string& cpf_of_on) {
    passes::Report report;
    return valid(passes::narrow_objects(grounded(of_cells(cpf_of_on)), report));
}
std::string value_of_on(const ir::Program& program) {
    const std::string text = step_text(program), name = "next.on[x, y] = ";
    const std::size_t begin = text.find(name) + name.size();
    return text.substr(begin, text.find('\n', begin) - begin);
}

TEST(NarrowObjects, KnowsInBranchesWhatTheirConditionSays) {
    EXPECT_EQ(value_of_on(narrowed("if (FIRST(?x)) then (NOT-FIRST(?x) | on(?x, ?y)) else "
                                   "(NOT-FIRST(?x) ^ HIGH(?y) ^ a(?y))")),
              "select(FIRST[x], state.on[x, y], HIGH[y] && action.a[y])");
    EXPECT_EQ(value_of_on(narrowed("if (FIRST(?x)) then on(?x, ?y) else if (NOT-FIRST(?x)) then "
                                   "a(?y) else HIGH(?y)")),
              "select(FIRST[x], state.on[x, y], action.a[y])");
}

TEST(NarrowObjects, KnowsInConditionsWhatTheirOtherPartsSay) {
    EXPECT_EQ(value_of_on(narrowed("on(?x, ?y) ^ FIRST(?x) | FIRST(?x) ^ ~NOT-FIRST(?x) ^ a(?y)")),
              "state.on[x, y] && FIRST[x] || FIRST[x] && action.a[y]");
    EXPECT_EQ(value_of_on(narrowed("FIRST(?x) | (NOT-FIRST(?x) ^ a(?y))")),
              "FIRST[x] || action.a[y]");
}

// A part that faults is evaluated for the objects for which it was.
TEST(NarrowObjects, GuardsFaultsAndDraws) {
    for (const char* cpf :
         {"(if (FIRST(?x)) then on(?x, ?y) else pow[2, v(?y)] > 3) ^ ~NOT-FIRST(?x)",
          "(if (~NOT-FIRST(?x)) then Bernoulli(0.5) else a(?y)) ^ FIRST(?x)"}) {
        const ir::Program before = grounded(of_cells(cpf));
        EXPECT_EQ(value_of_on(narrowed(cpf)), value_of_on(before));
    }
}

ir::Program with_joined_places(const std::string& cpf_of_on) {
    passes::Report report;
    return valid(
        passes::narrow_objects(passes::read_places(grounded(of_cells(cpf_of_on)), report), report));
}

TEST(NarrowObjects, JoinsPlacesThatAgreeWhereTheyAreRead) {
    const ir::Program program = with_joined_places(
        "if (FIRST(?x)) then a(?y) else if (HIGH(?y)) then on(BEFORE(?x), ?y) "
        "else on(LEFT(?x), ?y)");
    EXPECT_EQ(value_of_on(program),
              "select(on-table[x, y], element(action.a, on-places[x, y]), "
              "element(state.on, on-places-2[x, y]))");
    EXPECT_EQ(table_text(program, "on-places-2["),
              "on-places-2[obj, obj]: int = {0 0 0 0 1 2 3 4 5}");
}

// The first places that are read are 1, 2, 4 and 5, in columns b2 and b3.
TEST(NarrowObjects, MakesLinesOfPlacesThatAreNotRead) {
    const ir::Program program =
        with_joined_places("if (FIRST(?x) | ~HIGH(?y)) then a(?y) else on(BEFORE(?x), ?y)");
    EXPECT_EQ(table_text(program, "on-places-2["),
              "on-places-2[obj, obj]: int = {1 1 1 1 1 2 3 4 5}");
}

}  // namespace
}  // namespace rddlc
