#include "problem.hpp"

#include <gtest/gtest.h>

namespace rddlc {
namespace {

std::string refusal(const std::string& pvariables, const std::string& cpfs,
                    const std::string& non_fluents = {}) {
    const Problem problem{.pvariables = pvariables, .cpfs = cpfs, .non_fluents = non_fluents};
    const Grounded result = ground_text(problem.text());
    EXPECT_FALSE(result.program);
    return result.messages;
}

void expect_refused(const std::string& messages, const std::string& what) {
    EXPECT_NE(messages.find("error: valid RDDL, not supported yet: " + what + " [E0601]"),
              std::string::npos)
        << messages;
}

TEST(Unsupported, ExternalFunctions) {
    expect_refused(
        refusal("v(obj) : { state-fluent, real, default = 1.0 };", "v'(?o) = 1.0 + $f[?o](v(_));"),
        "the external function '$f'");
}

TEST(Unsupported, AreReportedAllAtOnce) {
    const std::string messages = refusal(
        "v(obj) : { state-fluent, real, default = 1.0 };\n"
        "w(obj) : { state-fluent, real, default = 1.0 };",
        "v'(?o) = $f[?o](v(_)) * $g[?o](w(_));\n"
        "w'(?o) = if (v(?o) > 0) then $h[?o](v(_)) else 0;");
    expect_refused(messages, "the external function '$f'");
    expect_refused(messages, "the external function '$g'");
    expect_refused(messages, "the external function '$h'");
}

TEST(Unsupported, TooManyGroundingsOfADraw) {
    std::string objects = "b1";
    for (int i = 2; i <= 300; ++i) objects += ", b" + std::to_string(i);
    Problem problem{.pvariables = "x : { state-fluent, real, default = 0.0 };",
                    .cpfs = "x' = sum_{?a : obj, ?b : obj, ?c : obj, ?d : obj} Normal(0, 1);"};
    std::string text = problem.text();
    text.replace(text.find("b1, b2, b3"), 10, objects);
    const Grounded result = ground_text(text);
    EXPECT_FALSE(result.program);
    EXPECT_NE(result.messages.find("'Normal' has 8100000000 groundings, more than 4294967295 "
                                   "[E0603]"),
              std::string::npos)
        << result.messages;
}

}  // namespace
}  // namespace rddlc
