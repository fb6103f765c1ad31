#include "passes/arithmetic/byte_ints.hpp"

#include "passes/passes.hpp"
#include "texts.hpp"

#include <string>

namespace rddlc {
namespace {

constexpr const char* small = "x >= 0; x <= 9;";

bool fit(const std::string& next, const std::string& invariants = small,
         const std::string& reward = "x") {
    const Problem problem{.pvariables =
                              "x : { state-fluent, int, default = 2 };\n"
                              "p(obj) : { state-fluent, bool, default = false };\n"
                              "HUGE : { non-fluent, int, default = 1000 };\n"
                              "LOTS(obj) : { non-fluent, int, default = 100 };\n"
                              "go(obj) : { action-fluent, bool, default = false };",
                          .cpfs = "x' = " + next + ";\np'(?o) = go(?o);",
                          .reward = reward,
                          .blocks = "state-invariants { " + invariants + " };"};
    return passes::has_byte_ints(grounded(problem));
}

TEST(ByteInts, AreThoseThatInvariantsBound) {
    EXPECT_TRUE(fit("x + (sum_{?o : obj} go(?o)) - 1"));
    EXPECT_TRUE(fit("max[0, min[9, x - 1]]"));
    EXPECT_FALSE(fit("max[0, min[9, x - 1]]", "x <= 9;"));
    EXPECT_FALSE(fit("max[0, min[9, x - 1]]", "x >= 3; x <= 9;"));  // it begins with 2
    EXPECT_FALSE(fit("max[0, min[9, x - 1]]", "x >= 0; x <= 200;"));
}

TEST(ByteInts, AreAllThatAStepComputes) {
    EXPECT_FALSE(fit("min[x, HUGE]"));
    EXPECT_FALSE(fit("if (x * 100 > 50) then 1 else 2"));
    EXPECT_FALSE(fit("x", small, "x * 20"));
    EXPECT_FALSE(fit("x", small, "sum_{?o : obj} [LOTS(?o) * go(?o)]"));
}

// The next state may leave the bounds, and conditions are evaluated there too.
TEST(ByteInts, AreThoseOfConditionsOnTheNextState) {
    EXPECT_TRUE(fit("x + 100", std::string(small)));
    EXPECT_FALSE(fit("x + 100", std::string(small) + " x + 50 > 0;"));
}

TEST(ByteInts, HaveOnlySomeOperators) {
    EXPECT_FALSE(fit("div[x, 2]"));
    EXPECT_FALSE(fit("if (abs[x] > 1) then 1 else 2"));
}

// Counts of true bools, after passes that count the bits of words; `bools` for more work on bools.
bool words_fit(const std::string& next, const std::string& bools) {
    const Problem problem{.pvariables =
                              "p(obj) : { state-fluent, bool, default = false };\n"
                              "q(obj, obj, obj) : { state-fluent, bool, default = false };\n"
                              "go(obj) : { action-fluent, bool, default = false };",
                          .cpfs = "p'(?x) = " + next + ";\nq'(?x, ?y, ?z) = " + bools + ";"};
    return passes::has_byte_ints(optimise(grounded(problem)));
}

TEST(ByteInts, AreWordsOfFewBoolsInLargePacks) {
    const std::string few = "(sum_{?y : obj} p(?y)) == (sum_{?y : obj} go(?y))";
    const std::string all = "(sum_{?u : obj, ?v : obj, ?w : obj} q(?u, ?v, ?w)) == 9";
    const std::string product = "exists_{?w : obj} [q(?x, ?y, ?w) ^ q(?w, ?y, ?z) | q(?y, ?w, ?x)]";
    EXPECT_TRUE(words_fit(few, product));
    EXPECT_FALSE(words_fit(few, "(sum_{?w : obj} q(?x, ?y, ?w)) > 1"));
    EXPECT_FALSE(words_fit(all, product));
}

}  // namespace
}  // namespace rddlc
