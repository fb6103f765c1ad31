#include "ir/cost_model.hpp"

#include "programs.hpp"

#include <gtest/gtest.h>

namespace rddlc::ir {
namespace {

class CostModelTest : public testing::Test {
  protected:
    double cost_of(std::vector<Definition> step) {
        w.program.step = std::move(step);
        return cost_of_step(w.program) - step_cost;
    }
    NodeId is_high() {
        return w.apply(Operator::Greater, w.apply(Operator::Multiply, w.load(w.level), w.real(1.5)),
                       w.real(4));
    }
    Workbench w;
};

// In operations: three iterations, each with a load, an And and a store.
constexpr double loop_of_and = 3 * (1 + 1 + 1 + 1);

TEST_F(CostModelTest, WhatALoopDoesNotChangeIsPaidOnce) {
    const NodeId value = w.apply(Operator::And, w.at(w.running, w.c), is_high());
    EXPECT_EQ(cost_of({w.fill(w.next_running, w.c, value)}), loop_of_and + 3);
}

TEST_F(CostModelTest, TheBitsOfATableArePaidOnceForAllRows) {
    const NodeId bits = w.builder().bits(w.running, 0);
    const NodeId has_any = w.apply(Operator::NotEqual, bits, w.integer(0));
    const NodeId value = w.apply(Operator::And, w.at(w.running, w.c), has_any);
    EXPECT_EQ(cost_of({w.fill(w.next_running, w.c, value)}), loop_of_and + 3 + 1);
}

TEST_F(CostModelTest, WhatStandsTwiceIsPaidOnceInADefinitionAndAgainInTheNext) {
    const NodeId level = w.apply(Operator::Exp, w.load(w.level));
    const Definition once = w.assign(w.next_level, level);
    const Definition twice = w.assign(w.next_level, w.apply(Operator::Add, level, level));
    const double single = cost_of({once});
    EXPECT_EQ(single, 1 + elementary_cost + 1);
    EXPECT_EQ(cost_of({twice}), single + 1);
    EXPECT_EQ(cost_of({once, once}), 2 * single);
}

TEST_F(CostModelTest, AnAggregationPaysItsTermsForEachObject) {
    const NodeId number = w.builder().convert(w.at(w.running, w.d), Scalar::Real);
    const NodeId sum = w.builder().reduce(Reduction::Sum, w.d, number);
    EXPECT_EQ(cost_of({w.assign(w.next_level, sum)}), 3 * (1 + 1) + 1);
    // The sum does not depend on the loop around it.
    const NodeId value = w.apply(Operator::And, w.at(w.running, w.c),
                                 w.apply(Operator::Greater, sum, w.load(w.level)));
    EXPECT_EQ(cost_of({w.fill(w.next_running, w.c, value)}), loop_of_and + 3 * (1 + 1) + 1 + 1);
}

TEST_F(CostModelTest, ANameCostsNothing) {
    const LocalId local{w.program.local_count++};
    const NodeId value = w.apply(Operator::Exp, w.load(w.level));
    const NodeId name = w.builder().local(local, Scalar::Real);
    Definition named = w.assign(w.next_level, w.apply(Operator::Add, name, w.real(1)));
    named.body.insert(named.body.begin(), Statement{Let{local, value}});
    const Definition plain = w.assign(w.next_level, w.apply(Operator::Add, value, w.real(1)));
    EXPECT_EQ(cost_of({named}), cost_of({plain}));
}

// A name whose value depends on the loop stays in it, as does what is computed from it.
TEST_F(CostModelTest, ANameInALoopIsPaidInEachIteration) {
    const LocalId local{w.program.local_count++};
    Definition named =
        w.fill(w.next_running, w.c, w.apply(Operator::Not, w.builder().local(local, Scalar::Bool)));
    auto& loop = std::get<Loop>(named.body.front().form);
    loop.body.insert(loop.body.begin(), Statement{Let{local, w.at(w.running, w.c)}});
    EXPECT_EQ(cost_of({named}), loop_of_and);
}

TEST_F(CostModelTest, ALoopOverSeveralObjectsMakesFourIterationsAtOnce) {
    Definition together = w.fill(w.next_running, w.c, w.at(w.running, w.c));
    const double apart = cost_of({together});
    std::get<Loop>(together.body.front().form).several_at_once = true;
    EXPECT_EQ(cost_of({together}), apart / 3) << "three objects in one iteration";
}

TEST_F(CostModelTest, ALoopOverSeveralObjectsIsItsOwnBesideOneOverTheSameObjects) {
    const Definition one = w.fill(w.next_running, w.c, w.at(w.running, w.c));
    const Definition other = w.fill(w.seen, w.c, w.apply(Operator::Not, w.at(w.reboot, w.c)));
    Definition both = one;
    both.body.push_back(other.body.front());
    std::get<Loop>(both.body.back().form).several_at_once = true;
    EXPECT_EQ(cost_of({both}), cost_of({one}) + cost_of({other}) / 3);
}

}  // namespace
}  // namespace rddlc::ir
