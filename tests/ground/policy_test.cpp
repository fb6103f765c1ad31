// Policy blocks in the IR: the simulator beside them stays as it is.
#include "ir/analysis.hpp"
#include "passes/passes.hpp"
#include "problem.hpp"

#include <gtest/gtest.h>

namespace rddlc {
namespace {

const Problem with_action{
    .pvariables =
        "R(obj) : { non-fluent, real, default = 1.0 };\n"
        "v(obj) : { state-fluent, real, default = 1.0 };\n"
        "a(obj) : { action-fluent, real, default = 0.0 };",
    .cpfs = "v'(?o) = v(?o) + R(?o) * a(?o) + Normal(0, 1);",
    .non_fluents = "R(b2) = 2.5;",
};

const std::string policy =
    "policy p { pvariables {\n"
    " GAIN : { param-fluent, real, default = 0.25 };\n"
    " m(obj) : { state-fluent, real, default = 0.5 };\n"
    " unread : { derived-fluent, real }; };\n"
    "cpfs { a(?o) = GAIN * (sum_{?u : obj} v(?u)) * v(?o) + R(?o) * Uniform(0, 1);\n"
    " unread = 3 * GAIN;\n"
    " m'(?o) = m(?o) + a(?o) + (sum_{?u : obj} v(?u)); }; }\n";

ir::Program with_policy() {
    Grounded result = ground_text(with_action.text() + policy);
    if (!result.program) throw std::runtime_error(result.messages);
    for (const std::string& complaint : ir::verify(*result.program)) ADD_FAILURE() << complaint;
    return std::move(*result.program);
}

std::string part(const std::string& text, const std::string& begin, const std::string& end) {
    const std::size_t from = text.find(begin);
    return text.substr(from, text.find(end, from) - from);
}

TEST(Policy, ComesBehindTheSimulatorAndDrawsAtSitesOfItsOwn) {
    const std::string text = ir::print(with_policy());
    EXPECT_EQ(part(text, "\nsites\n", "#"),
              "\nsites\n    @0 Normal over o in obj\n"
              "    @1 Uniform over o in obj\n");
    EXPECT_EQ(part(text, "memory\n", "\n\n"), "memory\n    m[obj]: real = 0.5");
    EXPECT_NE(text.find("next_memory.m[o] = "), std::string::npos) << text;
}

TEST(Policy, LeavesTheStepAsItIs) {
    EXPECT_EQ(step_text(with_policy()), step_text(grounded(with_action)));
    EXPECT_EQ(step_text(optimise(with_policy())), step_text(optimise(grounded(with_action))));
}

TEST(Policy, IsOptimisedLikeTheStep) {
    const std::string text = ir::print(optimise(with_policy()));
    const std::string act = part(text, "\npolicy p\n", "\n\n");
    EXPECT_EQ(act.find("unread"), std::string::npos) << "nobody reads it";
    EXPECT_NE(act.find("let %"), std::string::npos) << "the sum does not depend on the loop";
    EXPECT_NE(act.find("0.25"), std::string::npos) << "the parameter is a constant";
}

TEST(Policy, IsStochasticByItself) {
    const Problem quiet{.pvariables =
                            "n : { state-fluent, int, default = 0 };\n"
                            "a : { action-fluent, bool, default = false };",
                        .cpfs = "n' = n + a;"};
    const Grounded coin = ground_text(quiet.text() + "policy p { cpfs { a = Bernoulli(0.5); }; }");
    ASSERT_TRUE(coin.program) << coin.messages;
    EXPECT_FALSE(ir::is_stochastic(*coin.program));
    EXPECT_TRUE(ir::is_policy_stochastic(*coin.program));
    EXPECT_FALSE(ir::is_policy_stochastic(grounded(with_action)));
    EXPECT_TRUE(ir::is_stochastic(grounded(with_action)));
}

TEST(Policy, MustFillItsRecords) {
    ir::Program program = with_policy();
    program.policy->act.erase(program.policy->act.begin());  // a, which m' reads
    std::string complaints;
    for (const std::string& complaint : ir::verify(program)) complaints += complaint + "\n";
    EXPECT_NE(complaints.find("'a' is read before it is computed"), std::string::npos)
        << complaints;
    EXPECT_NE(complaints.find("nothing computes 'a'"), std::string::npos) << complaints;
}

TEST(Policy, MayNotTouchWhatIsNotItsOwn) {
    ir::Program program = with_policy();
    program.policy->act.push_back(program.step.front());
    std::string complaints;
    for (const std::string& complaint : ir::verify(program)) complaints += complaint + "\n";
    EXPECT_NE(complaints.find("'v' is read only"), std::string::npos) << complaints;
}

}  // namespace
}  // namespace rddlc
