#include "passes/arithmetic/shorten_invariants.hpp"

#include "texts.hpp"

#include <string>

namespace rddlc {
namespace {

// The text of the invariant that the pass leaves, where speed(?o) and x have these CPFs.
std::string left_of(const std::string& invariant, const std::string& cpf_of_speed,
                    const std::string& cpf_of_x = "x") {
    const Problem problem{
        .pvariables =
            "FASTEST(obj) : { non-fluent, real, default = 2.0 };\n"
            "speed(obj) : { state-fluent, real, default = 0.0 };\n"
            "x : { state-fluent, real, default = 0.0 };\n"
            "y : { state-fluent, real, default = 0.0 };",
        .cpfs = "speed'(?o) = " + cpf_of_speed + ";\nx' = " + cpf_of_x + ";\ny' = y;",
        .blocks = "state-invariants { " + invariant + "; };",
        .non_fluents = "FASTEST(b2) = 4.0;"};
    passes::Report report;
    const std::string text =
        ir::print(valid(passes::shorten_invariants(grounded(problem), report)));
    const std::size_t begin = text.find("\ninvariant 0 = ") + 15;
    return text.substr(begin, text.find('\n', begin) - begin);
}

TEST(ShortenInvariants, LeavesTheBoundThatFindsNan) {
    EXPECT_EQ(left_of("x >= -1.0 ^ x <= 3.0", "0.0", "max[-1.0, x - 1.0]"), "state.x <= 3.0");
    EXPECT_EQ(left_of("x >= -1.0 ^ x < 2.0", "0.0", "min[3.0, max[-1.0, x - 1.0]]"),
              "state.x < 2.0");
    EXPECT_EQ(left_of("x >= -1.0 ^ x <= 3.0", "0.0", "min[3.0, max[-1.0, x - 1.0]]"),
              "state.x <= 3.0")
        << "nan violates the invariant";
}

TEST(ShortenInvariants, OfAllObjects) {
    EXPECT_EQ(left_of("forall_{?o : obj} [speed(?o) >= 0.0 ^ speed(?o) <= FASTEST(?o)]",
                      "max[0.0, speed(?o) + x]"),
              "forall[o in obj](state.speed[o] <= FASTEST[o])");
    EXPECT_EQ(left_of("forall_{?o : obj} [x > 0.0 ^ speed(?o) >= 0.0 ^ speed(?o) <= 4.0]",
                      "min[FASTEST(?o), speed(?o) + x]"),
              "forall[o in obj](state.x > 0.0 && state.speed[o] >= 0.0)");
}

TEST(ShortenInvariants, LeavesWhatAStepMayViolate) {
    const auto with_maximum = [](const std::string& invariant) {
        return left_of(invariant, "0.0", "max[-1.0, x - 1.0]");
    };
    EXPECT_EQ(with_maximum("x >= -0.5 ^ x <= 3.0"), "state.x >= -0.5 && state.x <= 3.0");
    EXPECT_EQ(with_maximum("x > -1.0 ^ x <= 3.0"), "state.x > -1.0 && state.x <= 3.0");
    EXPECT_EQ(with_maximum("x >= -1.0 ^ x ~= 3.0"), "state.x >= -1.0 && state.x != 3.0");
    EXPECT_EQ(with_maximum("x >= -1.0 ^ y <= 3.0"), "state.x >= -1.0 && state.y <= 3.0");
    EXPECT_EQ(with_maximum("x >= -1.0"), "state.x >= -1.0");
}

}  // namespace
}  // namespace rddlc
