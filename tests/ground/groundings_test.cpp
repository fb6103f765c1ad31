#include "problem.hpp"

#include <gtest/gtest.h>

namespace rddlc {
namespace {

TEST(Groundings, AreTooManyForADraw) {
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
