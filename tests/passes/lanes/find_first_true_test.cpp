#include "passes/lanes/find_first_true.hpp"

#include "texts.hpp"

#include <string>

namespace rddlc {
namespace {

Problem with_greatest(const std::string& drawn, const std::string& best) {
    return {.pvariables =
                "p(obj) : { state-fluent, bool, default = false };\n"
                "v(obj) : { state-fluent, real, default = 0.0 };\n"
                "drawn(obj) : { interm-fluent, real };\n"
                "at(obj) : { state-fluent, bool, default = false };",
            .cpfs = "p'(?x) = p(?x);\nv'(?x) = v(?x);\ndrawn(?x) = " + drawn +
                    ";\nat'(?x) = ?x == (" + best + ");"};
}
std::string text_of(const Problem& problem, passes::Report& report) {
    return step_text(valid(passes::find_first_true(grounded(problem), report)));
}

TEST(FindFirstTrue, TakesTheLowestBitOfDrawnBools) {
    passes::Report report;
    const std::string text =
        text_of(with_greatest("Bernoulli(0.25)", "argmax_{?y : obj} [drawn(?y)]"), report);
    EXPECT_EQ(report["greatest of bools"], 1);
    EXPECT_NE(text.find("for x in obj, several at once\n"
                        "    scratch.drawn[x] = sample bernoulli@0[x](0.25)\n"),
              std::string::npos)
        << text;
    EXPECT_EQ(text.find("argmax"), std::string::npos) << text;
}
TEST(FindFirstTrue, TakesTheLowestBitOfTheState) {
    passes::Report report;
    const std::string text = text_of(with_greatest("v(?x)", "argmax_{?y : obj} [p(?y)]"), report);
    EXPECT_EQ(report["greatest of bools"], 1);
    EXPECT_NE(text.find("bits(state.p, 0)"), std::string::npos) << text;
}
TEST(FindFirstTrue, LeavesOthers) {
    for (const auto& [drawn, best] :
         {std::pair{"v(?x)", "argmax_{?y : obj} [drawn(?y)]"},
          std::pair{"Bernoulli(0.25)", "argmax_{?y : obj} [drawn(?y) + v(?y)]"},
          std::pair{"Bernoulli(0.25)", "argmin_{?y : obj} [drawn(?y)]"},
          std::pair{"Bernoulli(0.25) * 2", "argmax_{?y : obj} [drawn(?y)]"}}) {
        passes::Report report;
        text_of(with_greatest(drawn, best), report);
        EXPECT_EQ(report["greatest of bools"], 0) << best;
    }
}

}  // namespace
}  // namespace rddlc
