#include "problem.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>

namespace rddlc {
namespace {

// How many of the 20 bools of `go` and of the 400 of `visit` may be true.
std::string most_true(const std::string& preconditions, const std::string& most = "pos-inf") {
    const Problem problem = {.pvariables =
                                 "MOST : { non-fluent, int, default = 4 };\n"
                                 "n : { state-fluent, int, default = 3 };\n"
                                 "p(obj) : { state-fluent, bool, default = false };\n"
                                 "go(obj) : { action-fluent, bool, default = false };\n"
                                 "visit(obj, obj) : { action-fluent, bool, default = false };",
                             .cpfs = "n' = n; p'(?o) = p(?o);",
                             .blocks = "action-preconditions { " + preconditions + " };"};
    std::string limited = problem.text();
    const std::string unlimited = "max-nondef-actions = pos-inf";
    limited.replace(limited.find(unlimited), unlimited.size(), "max-nondef-actions = " + most);
    const ir::Program program = grounded_with_many(limited);
    std::string text;
    for (const ir::Buffer& buffer : program.buffers) {
        if (buffer.storage != ir::Storage::Action) continue;
        text += (text.empty() ? "" : " ") + buffer.name + ":";
        text += buffer.most_true ? std::to_string(*buffer.most_true) : "-";
    }
    return text;
}

const std::string all_go = "(sum_{?o : obj} [go(?o)])";
const std::string all_visits = "(sum_{?o : obj, ?u : obj} [visit(?o, ?u)])";

TEST(MostTrue, IsWhatAnActionMayChange) {
    EXPECT_EQ(most_true("n >= 0;"), "go:- visit:-");
    EXPECT_EQ(most_true("n >= 0;", "2"), "go:2 visit:2");
    EXPECT_EQ(most_true(all_go + " <= MOST;", "2"), "go:2 visit:2");
}

TEST(MostTrue, IsTheLimitOfASum) {
    EXPECT_EQ(most_true(all_go + " <= MOST;"), "go:4 visit:-");
    EXPECT_EQ(most_true("MOST > " + all_go + ";"), "go:3 visit:-");
    EXPECT_EQ(most_true(all_visits + " == 1;"), "go:- visit:1");
    EXPECT_EQ(most_true(all_go + " + (sum_{?o : obj, ?u : obj} [3 * visit(?o, ?u)]) <= 7.5;"),
              "go:7 visit:2");
    EXPECT_EQ(most_true("n >= 0 ^ " + all_go + " <= MOST;"), "go:4 visit:-");
    EXPECT_EQ(most_true("(sum_{?o : obj} [0.25 * go(?o)]) < 1.0;"), "go:3 visit:-");
}

TEST(MostTrue, IsTheSumOfTheLimitsOfRows) {
    EXPECT_EQ(most_true("forall_{?u : obj} [(sum_{?o : obj} [visit(?o, ?u)]) <= 2];"),
              "go:- visit:40");
}

TEST(MostTrue, IsUnknownWhereTermsMayBeNegativeOrTheLimitMayBeAnything) {
    for (const std::string& condition :
         {all_go + " <= n", all_go + " - " + all_visits + " <= MOST", all_go + " + n <= MOST",
          all_go + " >= MOST", std::string("(sum_{?o : obj} [visit(?o, ?o)]) <= MOST"),
          std::string("(sum_{?o : obj} [go(?o) ^ p(?o)]) <= MOST"),
          "(" + all_go + " <= MOST) | (n > 2)"})
        EXPECT_EQ(most_true(condition + ";"), "go:- visit:-") << condition;
}

}  // namespace
}  // namespace rddlc
