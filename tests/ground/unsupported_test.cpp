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

TEST(Unsupported, RandomVectors) {
    const std::string messages = refusal(
        "MEAN(obj) : { non-fluent, real, default = 0.0 };\n"
        "COV(obj, obj) : { non-fluent, real, default = 1.0 };\n"
        "v(obj) : { state-fluent, real, default = 0.0 };",
        "v'(?o) = MultivariateNormal[?o](MEAN(_), COV(_, _));");
    expect_refused(messages, "the random vector 'MultivariateNormal'");
}

TEST(Unsupported, MatrixFunctions) {
    expect_refused(refusal("m(obj, obj) : { state-fluent, real, default = 1.0 };",
                           "m'(?r, ?c) = inverse[row=?r, col=?c][m(?r, ?c)];"),
                   "the matrix function 'inverse'");
    expect_refused(refusal("m(obj, obj) : { state-fluent, real, default = 1.0 };",
                           "m'(?r, ?c) = det_{?x : obj, ?y : obj} m(?x, ?y);"),
                   "the matrix function 'det'");
}

TEST(Unsupported, ExternalFunctions) {
    expect_refused(
        refusal("v(obj) : { state-fluent, real, default = 1.0 };", "v'(?o) = 1.0 + $f[?o](v(_));"),
        "the external function '$f'");
}

TEST(Unsupported, AreReportedAllAtOnce) {
    const std::string messages = refusal(
        "m(obj, obj) : { state-fluent, real, default = 1.0 };\n"
        "v(obj) : { state-fluent, real, default = 1.0 };",
        "m'(?r, ?c) = cholesky[row=?r, col=?c][m(?r, ?c)];\n"
        "v'(?o) = $f[?o](v(_)) * det_{?x : obj, ?y : obj} m(?x, ?y);");
    expect_refused(messages, "the matrix function 'cholesky'");
    expect_refused(messages, "the external function '$f'");
    expect_refused(messages, "the matrix function 'det'");
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
