#include "passes/lanes/name_elements.hpp"

#include "passes/lanes/evaluate_together.hpp"
#include "passes/lanes/read_places.hpp"
#include "texts.hpp"

#include <string>

namespace rddlc {
namespace {

// The text of the loop over twenty objects, of which `up` has a bool, after the pass.
std::string named(const std::string& cpf_of_up) {
    std::string next = "OPEN(b2);";
    for (int i = 1; i <= 20; ++i)
        next += " NEXT(b" + std::to_string(i) + ") = b" + std::to_string(i % 20 + 1) + ";";
    const Problem problem{.pvariables =
                              "NEXT(obj) : { non-fluent, obj };\n"
                              "OPEN(obj) : { non-fluent, bool, default = false };\n"
                              "up(obj) : { state-fluent, bool, default = false };\n",
                          .cpfs = "up'(?x) = " + cpf_of_up + ";",
                          .non_fluents = next};
    passes::Report report;
    return step_text(valid(passes::name_elements(
        passes::evaluate_together(passes::read_places(grounded_with_many(problem), report), report),
        report)));
}

TEST(NameElements, NamesThoseThatStandSeveralTimes) {
    EXPECT_EQ(named("if (up(?x)) then ~up(NEXT(?x)) else OPEN(?x) ^ up(NEXT(?x))"),
              "for x in obj, as words\n"
              "    let %0 = element(state.up, up-places[x])\n"
              "    next.up[x] = select(state.up[x], !%0, OPEN[x] && %0)\n");
}

TEST(NameElements, LeavesThoseThatStandOnce) {
    const std::string text = named("if (up(?x)) then OPEN(?x) else up(NEXT(?x))");
    EXPECT_NE(text.find(", as words"), text.npos) << text;
    EXPECT_EQ(text.find("let"), text.npos) << text;
}

}  // namespace
}  // namespace rddlc
