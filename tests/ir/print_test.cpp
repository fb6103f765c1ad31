#include "ir/print.hpp"

#include "programs.hpp"

#include <gtest/gtest.h>

namespace rddlc::ir {
namespace {

TEST(Print, ShowsAWholeProgram) {
    Workbench w;
    add_step(w);
    EXPECT_EQ(print(w.program), R"(program d i

types
    computer: c1 c2 c3

constant
    REBOOT-PROB: real = 0.5
    CONNECTED[computer]: bool = {true false true}

state
    running[computer]: bool = {true true false}
    level: real = 2.0
    count: int = 7

action
    reboot[computer]: bool = false

scratch
    seen[computer]: bool

next
    running[computer]: bool
    level: real
    count: int

step
    for c in computer
        scratch.seen[c] = state.running[c] && CONNECTED[c]
    for c in computer
        next.running[c] = select(action.reboot[c], true, state.running[c] && sample bernoulli@0[c](0.5))
    next.level = state.level * 1.5
    next.count = state.count + 1

reward = sum[c in computer](real(scratch.seen[c]))
precondition 0 = exists[c in computer](action.reboot[c])
invariant 0 = state.count <= 8
termination 0 = state.level > 4.0

sites
    @0 Bernoulli over c in computer
    @1 pow
    @2 Normal over c in computer
)");
}

class PrintTest : public testing::Test {
  protected:
    NodeId level() { return w.load(w.level); }
    std::string text(NodeId id) { return print(w.program, id); }
    Workbench w;
};

TEST_F(PrintTest, ParenthesisesOnlyWhereNeeded) {
    const NodeId two = w.real(2);
    const NodeId sum = w.apply(Operator::Add, level(), two);
    EXPECT_EQ(text(w.apply(Operator::Multiply, sum, two)), "(state.level + 2.0) * 2.0");
    EXPECT_EQ(text(w.apply(Operator::Add, sum, two)), "state.level + 2.0 + 2.0");
    EXPECT_EQ(text(w.apply(Operator::Subtract, two, sum)), "2.0 - (state.level + 2.0)");
    EXPECT_EQ(text(w.apply(Operator::Negate, sum)), "-(state.level + 2.0)");
    EXPECT_EQ(text(w.apply(Operator::Hypot, sum, two)), "hypot(state.level + 2.0, 2.0)");
}

TEST_F(PrintTest, WritesRealsSoThatTheyReadAsReals) {
    EXPECT_EQ(text(w.real(3)), "3.0");
    EXPECT_EQ(text(w.real(0.1)), "0.1");
    EXPECT_EQ(text(w.real(1e300)), "1e+300");
    EXPECT_EQ(text(w.real(-0.0)), "-0.0");
}

TEST_F(PrintTest, ShowsDrawsAndFaultsWithTheirPlace) {
    const Place place{SiteId{2}, w.builder().index(w.c)};
    EXPECT_EQ(
        text(w.builder().sample(Scalar::Real, Distribution::Normal, place, {level(), w.real(1)})),
        "sample normal@2[c](state.level, 1.0)");
    EXPECT_EQ(text(w.builder().discrete(false, place, {level(), w.real(1)})),
              "sample discrete@2[c](state.level, 1.0)");
    EXPECT_EQ(text(w.builder().discrete_over(true, place, w.d, level())),
              "sample unnormdiscrete@2[c][d in computer](state.level)");
    EXPECT_EQ(text(w.builder().fault(Scalar::Real, place)), "fault@2[c]");
}

TEST_F(PrintTest, ShowsBounds) {
    const double infinity = std::numeric_limits<double>::infinity();
    w.program.fluents = {
        {"level", Role::State, Scalar::Real, {}, {}, w.level, {}, {}, {0}, {infinity}},
        {"count", Role::State, Scalar::Int, {}, {}, w.count, {}, {}, {-infinity}, {infinity}}};
    EXPECT_NE(print(w.program).find("bounds\n    level in 0.0 .. inf\n\nstep"), std::string::npos);
}

}  // namespace
}  // namespace rddlc::ir
