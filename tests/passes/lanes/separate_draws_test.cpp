#include "passes/lanes/separate_draws.hpp"

#include "passes/lanes/read_places.hpp"
#include "texts.hpp"

#include <string>

namespace rddlc {
namespace {

// 64 groups of three objects; the CPF of `on` is given.
ir::Program with_draws_apart(const std::string& cpf_of_on, passes::Report& report) {
    const Problem problem{
        .pvariables =
            "NEXT(obj) : { non-fluent, obj };\n"
            "ENTRY(obj, obj, obj, obj) : { non-fluent, bool, default = false };\n"
            "on(obj, obj, obj, obj) : { state-fluent, bool, default = false };\n"
            "go(obj) : { action-fluent, bool, default = false };",
        .cpfs = "on'(?x, ?y, ?z, ?w) = " + cpf_of_on + ";",
        .non_fluents = "NEXT(b1) = b2; NEXT(b2) = b3; NEXT(b3) = b1; ENTRY(b1, b2, b1, b1);"};
    passes::Report unused;
    return valid(passes::separate_draws(passes::read_places(grounded(problem), unused), report));
}

const std::string neighbours =
    "((on(NEXT(?x), ?y, ?z, ?w) ^ go(?x)) | (on(?x, NEXT(?y), ?z, ?w) ^ go(?y)) |"
    " (on(?x, ?y, NEXT(?z), ?w) ^ go(?z)))";

TEST(SeparateDraws, MakesThemBeforeWhatIsLeftInWords) {
    passes::Report report;
    const ir::Program program = with_draws_apart(
        "if (ENTRY(?x, ?y, ?z, ?w)) then Bernoulli(if (go(?x)) then 0.2 else 0.5) else " +
            neighbours,
        report);
    EXPECT_EQ(report["loops whose draws are made before"], 1);
    const std::string text = step_text(program);
    EXPECT_NE(text.find("for x in obj, several at once\n"), text.npos) << text;
    EXPECT_NE(text.find("scratch.on-draw[x, y, z, w] = select(ENTRY[x, y, z, w], "
                        "sample bernoulli@0[((x * 3 + y) * 3 + z) * 3 + w]("
                        "select(element(action.go, on-places[x, y, z, w]), 0.2, 0.5)), false)\n"),
              text.npos)
        << text;
    EXPECT_NE(text.find("for x in obj, as words\n"), text.npos) << text;
    EXPECT_NE(text.find("select(ENTRY[x, y, z, w], scratch.on-draw[x, y, z, w], "), text.npos)
        << text;
}

// Where it takes most of the work to know which draws are needed, or little is left without them,
// or registers of bools can make them.
TEST(SeparateDraws, LeavesThemWhereTheyAre) {
    const std::string draw = "Bernoulli(if (go(?x)) then 0.2 else 0.5)";
    for (const std::string& cpf :
         {"if (" + neighbours + ") then " + draw + " else on(?x, ?y, ?z, ?w)",
          "if (go(NEXT(?x))) then " + draw + " else on(?x, ?y, ?z, ?w)",
          "if (ENTRY(?x, ?y, ?z, ?w)) then Bernoulli(0.5) else " + neighbours,
          "Bernoulli(if (" + neighbours + ") then 0.2 else 0.5)"}) {
        passes::Report report;
        with_draws_apart(cpf, report);
        EXPECT_TRUE(report.empty()) << cpf;
    }
}

}  // namespace
}  // namespace rddlc
