#include "passes/aggregations/draw_over_objects.hpp"

#include "texts.hpp"

#include <string>

namespace rddlc {
namespace {

// The CPF of the color of an object.
Problem with_colors(const std::string& cpf_of_c) {
    return {.pvariables =
                "W(obj, color) : { non-fluent, real, default = 0.5 };\n"
                "s(color) : { state-fluent, real, default = 1.0 };\n"
                "c(obj) : { state-fluent, color, default = @red };",
            .cpfs = "s'(?k) = s(?k);\nc'(?o) = " + cpf_of_c + ";",
            .non_fluents = "W(b1, @green) = 0.25; W(b2, @red) = 0.125;"};
}

struct Drawn {
    std::string before, after;
    passes::Report report;
};
Drawn drawn(const std::string& cpf_of_c) {
    Drawn result;
    ir::Program program = grounded(with_colors(cpf_of_c));
    result.before = step_text(program);
    result.after = step_text(valid(passes::draw_over_objects(std::move(program), result.report)));
    return result;
}

TEST(DrawOverObjects, TakesWeightsThatAreOneExpression) {
    const Drawn result = drawn(
        "Discrete(color, @red : W(?o, @red) / s(@red), @green : W(?o, @green) / s(@green), "
        "@blue : W(?o, @blue) / s(@blue))");
    EXPECT_NE(result.after.find("next.c[o] = sample discrete@0[o][choice in color]("
                                "W[o, choice] / state.s[choice])"),
              std::string::npos)
        << result.after;
    EXPECT_EQ(result.report.at("draws over objects"), 1);
}

TEST(DrawOverObjects, ComputesPartsOfASumOnce) {
    const auto weight = [](const std::string& color) {
        return color + " : W(?o, " + color + ") * s(" + color +
               ") / (sum_{?k : color} [W(?o, ?k) * s(?k)])";
    };
    const Drawn result = drawn("Discrete(color, " + weight("@red") + ", " + weight("@green") +
                               ", " + weight("@blue") + ")");
    EXPECT_NE(result.after.find("for choice in color\n"
                                "    for o in obj\n"
                                "        scratch.c-parts[choice, o] = W[o, choice] * "
                                "state.s[choice]\n"
                                "for o in obj\n"
                                "    next.c[o] = sample discrete@0[o][choice in color]("
                                "scratch.c-parts[choice, o] / "
                                "sum[k in color](scratch.c-parts[k, o]))"),
              std::string::npos)
        << result.after;
}

TEST(DrawOverObjects, PutsNumbersIntoATable) {
    const Drawn result = drawn(
        "Discrete(color, @red : 0.5 * s(@red), @green : 0.25 * s(@green), "
        "@blue : 0.125 * s(@blue))");
    EXPECT_NE(result.after.find("[choice in color](c-weights[choice] * state.s[choice])"),
              std::string::npos)
        << result.after;
}

TEST(DrawOverObjects, LeavesWeightsOfSeveralForms) {
    for (const char* weights : {"@red : s(@red), @green : s(@blue) * 2, @blue : 0.5",
                                "@red : W(?o, @red), @green : W(?o, @green), @blue : 1.0 - s(@red)",
                                "@red : s(@red), @green : s(@red), @blue : s(@red)"}) {
        const Drawn result = drawn("Discrete(color, " + std::string(weights) + ")");
        EXPECT_EQ(result.before, result.after);
        EXPECT_TRUE(result.report.empty());
    }
}

}  // namespace
}  // namespace rddlc
