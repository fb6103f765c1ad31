// The fingerprint by which learners check that a resumed run has the dynamics that it began with.
#include "problem.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace rddlc {
namespace {

Problem queue_problem() {
    Problem problem = usual_problem("x + (sum_{?o : obj} R(?o)) * 0.25 + Normal(0.0, 1.0)");
    problem.reward = "x - 1.5";
    problem.blocks =
        "action-preconditions { f <= 3.0; };\nstate-invariants { x >= -9.0; };\n"
        "termination { x > 99.0; };";
    problem.init_state = "x = 1.25;";
    return problem;
}

std::uint64_t fingerprint_of(const std::string& text) {
    const Grounded result = ground_text(text);
    if (!result.program) throw std::runtime_error(result.messages);
    return result.program->fingerprint;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    if (at == text.npos) throw std::runtime_error("there is no " + from);
    return text.replace(at, from.size(), to);
}

TEST(DynamicsFingerprint, ChangesWithAllThatATrajectoryDependsOn) {
    const std::string text = queue_problem().text();
    std::set<std::uint64_t> all{fingerprint_of(text)};
    const std::vector<std::pair<std::string, std::string>> changes = {
        {"* 0.25", "* 0.2500000001"},
        {"Normal(0.0, 1.0)", "Normal(0.0, 2.0)"},
        {"x - 1.5", "x - 1.0"},
        {"f <= 3.0", "f <= 4.0"},
        {"x >= -9.0", "x >= -8.0"},
        {"x > 99.0", "x > 98.0"},
        {"R(b2) = 2.5", "R(b2) = 2.25"},
        {"B(b1, a2)", "B(b1, a1)"},
        {"real, default = 1.0 };\nB(", "real, default = 1.5 };\nB("},
        {"x = 1.25", "x = 1.0"},
        {"n : { state-fluent, int, default = 3", "n : { state-fluent, int, default = 5"},
        {"f : { action-fluent, real, default = 0.0", "f : { action-fluent, real, default = 1.0"},
        {"b3", "b3, b4"},
        {"max-nondef-actions = pos-inf", "max-nondef-actions = 2"},
        {"horizon = 10", "horizon = 11"},
        {"discount = 1.0", "discount = 0.9"}};
    for (const auto& [from, to] : changes)
        EXPECT_TRUE(all.insert(fingerprint_of(replaced(text, from, to))).second)
            << from << " -> " << to;
}

// Later values and objects also count, though --print=model shows only the first ones.
TEST(DynamicsFingerprint, ChangesWithTheLastValueOfALargeTable) {
    std::string objects = "b1";
    for (int i = 2; i <= 40; ++i) objects += ", b" + std::to_string(i);
    const std::string text = replaced(queue_problem().text(), "b1, b2, b3", objects);
    const std::uint64_t whole = fingerprint_of(text);
    EXPECT_NE(fingerprint_of(replaced(text, "R(b2) = 2.5;", "R(b2) = 2.5; R(b39) = 1.25;")), whole);
    EXPECT_NE(fingerprint_of(replaced(text, "R(b2) = 2.5;", "R(b2) = 2.5; R(b40) = 1.25;")),
              fingerprint_of(replaced(text, "R(b2) = 2.5;", "R(b2) = 2.5; R(b39) = 1.25;")));
    EXPECT_NE(fingerprint_of(replaced(text, "b40", "c40")), whole);
}

TEST(DynamicsFingerprint, DoesNotChangeWithCommentsAndLayout) {
    const std::string text = queue_problem().text();
    const std::uint64_t whole = fingerprint_of(text);
    EXPECT_NE(whole, 0u);
    EXPECT_EQ(fingerprint_of(text), whole);
    EXPECT_EQ(fingerprint_of("// a comment\n" + text), whole);
    EXPECT_EQ(fingerprint_of(replaced(text, "x + (sum_{?o : obj} R(?o)) * 0.25",
                                      "x\n  + (sum_{?o: obj} [R(?o)]) *0.250")),
              whole);
    EXPECT_EQ(fingerprint_of(replaced(text, "R(b2) = 2.5; B(b1, a2);", "B(b1, a2); R(b2) = 2.5;")),
              whole);
}

}  // namespace
}  // namespace rddlc
