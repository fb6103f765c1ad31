#include "ir/builder.hpp"

#include "ir/print.hpp"
#include "programs.hpp"

#include <rddl/values/ops.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rddlc::ir {
namespace {

constexpr std::int64_t least = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t greatest = std::numeric_limits<std::int64_t>::max();

class BuilderTest : public testing::Test {
  protected:
    std::string text(NodeId id) { return print(w.program, id); }
    NodeId level() { return w.load(w.level); }
    NodeId count() { return w.load(w.count); }
    NodeId up() { return w.at(w.running, w.c); }
    NodeId fallible() {
        return w.apply(Operator::Less, w.int_power(count(), count()), w.integer(3));
    }

    Workbench w;
};

TEST_F(BuilderTest, ConstantsHaveTheTypeOfTheirValue) {
    EXPECT_EQ(scalar_of(Value(true)), Scalar::Bool);
    EXPECT_EQ(scalar_of(Value(std::int64_t{1})), Scalar::Int);
    EXPECT_EQ(scalar_of(Value(1.0)), Scalar::Real);
}

TEST_F(BuilderTest, GivesEqualExpressionsEqualIds) {
    const NodeId a = w.apply(Operator::Add, level(), w.real(2.0));
    const NodeId b = w.apply(Operator::Add, level(), w.real(2.0));
    EXPECT_EQ(a, b);
    EXPECT_NE(a, w.apply(Operator::Add, w.real(2.0), level()));
    EXPECT_NE(w.real(0.0), w.real(-0.0));
    EXPECT_EQ(w.real(NAN), w.real(NAN));
    EXPECT_NE(w.integer(1), w.boolean(true));
}

// A part of a chain is left out if another part decides it.
TEST_F(BuilderTest, AbsorbsPartsOfChains) {
    const auto both = [&](NodeId a, NodeId b) {
        return w.apply(Operator::And, a, b);
    };
    const auto either = [&](NodeId a, NodeId b) {
        return w.apply(Operator::Or, a, b);
    };
    const NodeId few = w.apply(Operator::Less, count(), w.integer(3));
    const NodeId low = w.apply(Operator::Less, level(), w.real(0.5));
    EXPECT_EQ(both(both(up(), few), up()), both(up(), few));
    EXPECT_EQ(either(up(), both(few, up())), up());
    EXPECT_EQ(either(both(few, up()), up()), up());
    EXPECT_EQ(both(up(), either(few, up())), up());
    EXPECT_EQ(either(either(both(up(), few), low), up()), either(low, up()));
    EXPECT_EQ(either(both(both(up(), few), low), both(low, up())), both(low, up()));
    const NodeId unlike = either(both(up(), few), both(few, low));
    EXPECT_EQ(text(unlike), text(both(up(), few)) + " || " + text(both(few, low)));
}

TEST_F(BuilderTest, AbsorbsNoFaultsAndNoPartsOfLongChains) {
    const NodeId absorbed = w.apply(Operator::And, fallible(), up());
    EXPECT_NE(w.apply(Operator::Or, absorbed, up()), up());
    NodeId chain = up();
    for (std::int64_t least_count = 1; least_count < 20; ++least_count)
        chain = w.apply(Operator::And, chain,
                        w.apply(Operator::NotEqual, count(), w.integer(least_count)));
    EXPECT_NE(w.apply(Operator::And, chain, up()), chain);
}

// An index of a loop lies between 0 and the number of objects.
TEST_F(BuilderTest, KnowsTheOrderOfIntsFromTheirRanges) {
    const NodeId c = w.builder().index(w.c);
    const auto last = static_cast<std::int64_t>(w.program[w.c].size) - 1;
    ASSERT_GT(last, 0);
    EXPECT_EQ(w.apply(Operator::GreaterEqual, c, w.integer(0)), w.boolean(true));
    EXPECT_EQ(w.apply(Operator::Less, c, w.integer(0)), w.boolean(false));
    EXPECT_EQ(w.apply(Operator::Greater, w.integer(last + 1), c), w.boolean(true));
    EXPECT_EQ(w.apply(Operator::LessEqual, w.integer(last + 1), c), w.boolean(false));
    EXPECT_EQ(w.apply(Operator::Maximum, c, w.integer(0)), c);
    EXPECT_EQ(w.apply(Operator::Minimum, w.integer(last), c), c);
    EXPECT_EQ(w.apply(Operator::Minimum, c, w.integer(0)), w.integer(0));
    for (const NodeId open : {w.apply(Operator::Less, c, w.integer(last)),
                              w.apply(Operator::Less, count(), w.integer(0)),
                              w.apply(Operator::Maximum, c, w.integer(1))})
        EXPECT_TRUE(std::holds_alternative<Apply>(w.program[open].form)) << text(open);
    // These are the same double.
    const NodeId large = w.apply(Operator::Less, w.apply(Operator::Add, c, w.integer(greatest)),
                                 w.integer(greatest - 1));
    EXPECT_TRUE(std::holds_alternative<Apply>(w.program[large].form));
}

TEST_F(BuilderTest, FoldsConstantsAsTheRuntimeComputesThem) {
    EXPECT_EQ(w.apply(Operator::Add, w.integer(greatest), w.integer(1)), w.integer(least));
    EXPECT_EQ(w.apply(Operator::FloorDivide, w.integer(-7), w.integer(2)), w.integer(-4));
    EXPECT_EQ(w.apply(Operator::FloorDivide, w.integer(1), w.integer(0)), w.integer(0));
    EXPECT_EQ(w.apply(Operator::Round, w.real(2.5)), w.integer(2));
    EXPECT_EQ(w.apply(Operator::Floor, w.real(1e30)), w.integer(least));
    EXPECT_EQ(w.apply(Operator::Divide, w.real(1), w.real(0)), w.real(HUGE_VAL));
    EXPECT_EQ(w.apply(Operator::Exp, w.real(1.25)), w.real(rddl::exp(1.25)));
    EXPECT_EQ(w.apply(Operator::Less, w.real(NAN), w.real(1)), w.boolean(false));
    EXPECT_EQ(w.apply(Operator::Equal, w.boolean(true), w.boolean(true)), w.boolean(true));
    EXPECT_EQ(w.builder().convert(w.boolean(true), Scalar::Real), w.real(1));
}

TEST_F(BuilderTest, FoldsFallibleOperatorsUnlessTheyFault) {
    EXPECT_EQ(w.int_power(w.integer(3), w.integer(4)), w.integer(81));
    EXPECT_EQ(text(w.int_power(w.integer(3), w.integer(-1))), "power@1[0](3, -1)");
}

TEST_F(BuilderTest, ReadsConstantTablesAtConstantIndices) {
    EXPECT_EQ(w.load(w.reboot_prob), w.real(0.5));
    EXPECT_EQ(w.builder().load(w.connected, {w.integer(1)}), w.boolean(false));
    EXPECT_EQ(text(w.at(w.connected, w.c)), "CONNECTED[c]");
    EXPECT_EQ(text(w.builder().load(w.running, {w.integer(1)})), "state.running[1]");
}

TEST_F(BuilderTest, KnowsIdentitiesOfInts) {
    EXPECT_EQ(w.apply(Operator::Add, count(), w.integer(0)), count());
    EXPECT_EQ(w.apply(Operator::Add, w.integer(0), count()), count());
    EXPECT_EQ(w.apply(Operator::Subtract, count(), w.integer(0)), count());
    EXPECT_EQ(w.apply(Operator::Multiply, w.integer(1), count()), count());
    EXPECT_EQ(w.apply(Operator::Multiply, w.integer(0), count()), w.integer(0));
    EXPECT_EQ(w.apply(Operator::Negate, w.apply(Operator::Negate, count())), count());
    EXPECT_EQ(w.apply(Operator::Minimum, count(), count()), count());
    EXPECT_EQ(w.apply(Operator::Equal, count(), count()), w.boolean(true));
    const NodeId more = w.apply(Operator::Add, w.integer(3), count());
    EXPECT_EQ(text(w.apply(Operator::Subtract, more, w.integer(1))), "state.count + 2");
    EXPECT_EQ(w.apply(Operator::Subtract, more, w.integer(3)), count());
}

TEST_F(BuilderTest, KnowsIdentitiesOfBits) {
    const NodeId none = w.integer(0), all = w.integer(-1);
    EXPECT_EQ(w.apply(Operator::BitAnd, count(), none), none);
    EXPECT_EQ(w.apply(Operator::BitAnd, all, count()), count());
    EXPECT_EQ(w.apply(Operator::BitAnd, count(), count()), count());
    EXPECT_EQ(w.apply(Operator::BitOr, none, count()), count());
    EXPECT_EQ(w.apply(Operator::BitOr, count(), count()), count());
    EXPECT_EQ(w.apply(Operator::BitXor, count(), none), count());
    EXPECT_EQ(w.apply(Operator::CountOnes, all), w.integer(64));
}

TEST_F(BuilderTest, KnowsOnlyExactIdentitiesOfReals) {
    EXPECT_EQ(w.apply(Operator::Multiply, level(), w.real(1)), level());
    EXPECT_EQ(w.apply(Operator::Divide, level(), w.real(1)), level());
    EXPECT_EQ(w.apply(Operator::Subtract, level(), w.real(0)), level());
    EXPECT_EQ(w.apply(Operator::Add, level(), w.real(-0.0)), level());
    // -0.0 + 0.0 is 0.0, 0.0 - 0.0 is not -0.0; 0.0 * inf is nan; nan is not nan.
    EXPECT_NE(w.apply(Operator::Add, level(), w.real(0)), level());
    EXPECT_EQ(text(w.apply(Operator::Subtract, w.real(0), level())), "0.0 - state.level");
    EXPECT_NE(w.apply(Operator::Multiply, level(), w.real(0)), w.real(0));
    EXPECT_NE(w.apply(Operator::Equal, level(), level()), w.boolean(true));
}

TEST_F(BuilderTest, AddsZeroOnlyWhereItShows) {
    const auto sum = [&](NodeId a, NodeId b) {
        return w.apply(Operator::Add, a, b);
    };
    const NodeId zero = w.real(0.0), x = level(), begun = sum(zero, x);
    EXPECT_EQ(text(begun), "0.0 + state.level");
    EXPECT_EQ(sum(zero, begun), begun);
    EXPECT_EQ(sum(begun, zero), begun);
    const NodeId magnitude = w.apply(Operator::Abs, x);
    EXPECT_EQ(sum(zero, magnitude), magnitude);
    EXPECT_EQ(w.apply(Operator::Abs, begun), magnitude);
    EXPECT_EQ(w.apply(Operator::Less, begun, w.real(1)), w.apply(Operator::Less, x, w.real(1)));
    EXPECT_EQ(sum(begun, magnitude), sum(x, magnitude));
    EXPECT_EQ(text(sum(begun, w.apply(Operator::Sin, x))),
              "0.0 + (state.level + sin(state.level))");
    EXPECT_EQ(text(w.apply(Operator::Subtract, begun, magnitude)),
              "0.0 + (state.level - absolute(state.level))");
    EXPECT_EQ(text(w.apply(Operator::Subtract, begun, w.real(2))), "state.level - 2.0");
    EXPECT_EQ(text(w.apply(Operator::Subtract, w.real(2), begun)), "2.0 - state.level");
    EXPECT_EQ(text(w.apply(Operator::Subtract, x, begun)), "state.level - (0.0 + state.level)");
    EXPECT_EQ(text(w.apply(Operator::Maximum, zero, begun)), "maximum(0.0, state.level)");
    EXPECT_EQ(text(w.apply(Operator::Maximum, begun, zero)), "maximum(0.0 + state.level, 0.0)");
    EXPECT_EQ(text(w.apply(Operator::Minimum, zero, begun)), "minimum(0.0, state.level)");
    EXPECT_EQ(text(w.apply(Operator::Maximum, w.real(-1), begun)),
              "maximum(-1.0, 0.0 + state.level)");
    EXPECT_EQ(text(w.apply(Operator::Negate, begun)), "-(0.0 + state.level)");
    EXPECT_EQ(text(w.apply(Operator::Divide, w.real(1), begun)), "1.0 / (0.0 + state.level)");
}

TEST_F(BuilderTest, SimplifiesLogic) {
    EXPECT_EQ(w.apply(Operator::And, w.boolean(true), up()), up());
    EXPECT_EQ(w.apply(Operator::And, up(), w.boolean(false)), w.boolean(false));
    EXPECT_EQ(w.apply(Operator::Or, up(), w.boolean(true)), w.boolean(true));
    EXPECT_EQ(w.apply(Operator::Or, up(), up()), up());
    EXPECT_EQ(w.apply(Operator::Not, w.apply(Operator::Not, up())), up());
    EXPECT_EQ(text(w.apply(Operator::Implies, up(), w.at(w.reboot, w.c))),
              "!state.running[c] || action.reboot[c]");
    EXPECT_EQ(w.apply(Operator::Implies, w.boolean(true), up()), up());
    EXPECT_EQ(w.apply(Operator::Equivalent, w.boolean(false), up()), w.apply(Operator::Not, up()));
}

// The float next to this limit is 1.
TEST_F(BuilderTest, ComparesBoolsWithFloatsWhereStepsDo) {
    const NodeId number = w.builder().convert(up(), Scalar::Real), limit = w.real(1.00000001);
    EXPECT_NE(w.apply(Operator::GreaterEqual, number, limit), up());
    w.program.real = RealType::Float;
    EXPECT_EQ(w.apply(Operator::GreaterEqual, number, limit), up());
}

TEST_F(BuilderTest, TestsBoolsInPlaceOfTheirNumbers) {
    const NodeId number = w.builder().convert(up(), Scalar::Int);
    EXPECT_EQ(w.apply(Operator::Equal, number, w.integer(1)), up());
    EXPECT_EQ(w.apply(Operator::Equal, number, w.integer(0)), w.apply(Operator::Not, up()));
    EXPECT_EQ(w.apply(Operator::NotEqual, number, w.integer(0)), up());
    EXPECT_EQ(w.apply(Operator::NotEqual, number, w.integer(1)), w.apply(Operator::Not, up()));
}

TEST_F(BuilderTest, ComparesNumbersInPlaceOfSigns) {
    const NodeId sign = w.apply(Operator::Sign, level()), of_int = w.apply(Operator::Sign, count());
    EXPECT_EQ(text(w.apply(Operator::Equal, sign, w.integer(0))), "state.level == 0.0");
    EXPECT_EQ(text(w.apply(Operator::NotEqual, of_int, w.integer(0))), "state.count != 0");
    EXPECT_EQ(text(w.apply(Operator::Greater, sign, w.integer(0))), "sign(state.level) > 0");
    EXPECT_EQ(text(w.apply(Operator::Equal, sign, of_int)),
              "state.level > 0.0 == state.count > 0 && state.level < 0.0 == state.count < 0 && "
              "state.level == 0.0 == (state.count == 0)");
    // nan has a sign of its own, which these comparisons tell from that of 0.
    constexpr double inf = std::numeric_limits<double>::infinity();
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double a : {-2.0, -0.0, 0.0, 3.0, nan}) {
        for (const double b : {-inf, -0.0, 1.0, nan}) {
            const bool agree = (a > 0) == (b > 0) && (a < 0) == (b < 0) && (a == 0) == (b == 0);
            EXPECT_EQ(w.apply(Operator::Equal, w.apply(Operator::Sign, w.real(a)),
                              w.apply(Operator::Sign, w.real(b))),
                      w.boolean(agree))
                << a << ", " << b;
        }
    }
}

TEST_F(BuilderTest, NegatesOrdersOfIntsOnly) {
    const NodeId of_ints = w.apply(Operator::Less, count(), w.integer(3));
    EXPECT_EQ(text(w.apply(Operator::Not, of_ints)), "state.count >= 3");
    const NodeId of_reals = w.apply(Operator::Less, level(), w.real(3));
    EXPECT_EQ(text(w.apply(Operator::Not, of_reals)), "!(state.level < 3.0)");
    const NodeId equal = w.apply(Operator::Equal, level(), w.real(3));
    EXPECT_EQ(text(w.apply(Operator::Not, equal)), "state.level != 3.0");
}

TEST_F(BuilderTest, KeepsWhatMayFaultOrDraws) {
    const NodeId draw = w.bernoulli(w.real(0.5));
    EXPECT_NE(w.apply(Operator::And, draw, w.boolean(false)), w.boolean(false));
    EXPECT_NE(w.apply(Operator::And, fallible(), w.boolean(false)), w.boolean(false));
    const NodeId zero = w.apply(Operator::Multiply, w.integer(0), w.int_power(count(), count()));
    EXPECT_NE(zero, w.integer(0));
    EXPECT_NE(w.builder().select(fallible(), level(), level()), level());
}

TEST_F(BuilderTest, MakesFallibleRightOperandsLazy) {
    EXPECT_EQ(text(w.apply(Operator::And, up(), fallible())),
              "select(state.running[c], power@1[0](state.count, state.count) < 3, false)");
    EXPECT_EQ(text(w.apply(Operator::Or, up(), fallible())),
              "select(state.running[c], true, power@1[0](state.count, state.count) < 3)");
    EXPECT_EQ(text(w.apply(Operator::Implies, up(), fallible())),
              "select(state.running[c], power@1[0](state.count, state.count) < 3, true)");
    EXPECT_EQ(text(w.apply(Operator::And, fallible(), up())),
              "power@1[0](state.count, state.count) < 3 && state.running[c]");
}

TEST_F(BuilderTest, SimplifiesSelects) {
    const NodeId three = w.real(3);
    EXPECT_EQ(w.builder().select(w.boolean(true), three, level()), three);
    EXPECT_EQ(w.builder().select(w.boolean(false), three, level()), level());
    EXPECT_EQ(w.builder().select(up(), level(), level()), level());
    EXPECT_EQ(w.builder().select(up(), w.boolean(true), w.boolean(false)), up());
    EXPECT_EQ(w.builder().select(up(), w.boolean(false), w.boolean(true)),
              w.apply(Operator::Not, up()));
    EXPECT_EQ(w.builder().select(w.apply(Operator::Not, up()), three, level()),
              w.builder().select(up(), level(), three));
}

TEST_F(BuilderTest, FoldsReductionsOverConstants) {
    EXPECT_EQ(w.builder().reduce(Reduction::Sum, w.c, w.integer(5)), w.integer(15));
    EXPECT_EQ(w.builder().reduce(Reduction::Sum, w.c, w.real(0.1)), w.real(0.1 + 0.1 + 0.1));
    EXPECT_EQ(w.builder().reduce(Reduction::Product, w.c, w.real(0.5)), w.real(0.125));
    EXPECT_EQ(w.builder().reduce(Reduction::ForAll, w.c, w.boolean(false)), w.boolean(false));
    EXPECT_EQ(w.builder().reduce(Reduction::ArgMax, w.c, level()), w.integer(0));
    EXPECT_EQ(w.builder().reduce(Reduction::Maximum, w.c, level()), level());
    EXPECT_EQ(w.builder().reduce(Reduction::Exists, w.d, up()), up());
}

TEST_F(BuilderTest, KeepsReductionsOverAPart) {
    const NodeId up = w.load(w.count);
    const Bounds bounds{w.builder().index(w.d), w.integer(2)};
    EXPECT_EQ(text(w.builder().reduce(Reduction::Sum, w.c, up, bounds)),
              "sum[c in d .. 2](state.count)");
    EXPECT_EQ(text(w.builder().reduce(Reduction::Sum, w.c, w.integer(1), bounds)),
              "sum[c in d .. 2](1)");
    EXPECT_EQ(text(w.builder().reduce(Reduction::Sum, w.c, up, Bounds{bounds.end, bounds.end})),
              "0");
}

TEST_F(BuilderTest, FoldsReductionsOverOneOrNoObject) {
    EXPECT_EQ(w.builder().index(w.only), w.integer(0));
    EXPECT_EQ(text(w.builder().reduce(Reduction::Sum, w.only, level())), "0.0 + state.level")
        << "a sum is never -0.0";
    EXPECT_EQ(w.builder().reduce(Reduction::Product, w.only, level()), level());
    EXPECT_EQ(w.builder().reduce(Reduction::Sum, w.none, level()), w.real(0));
    EXPECT_EQ(w.builder().reduce(Reduction::Product, w.none, count()), w.integer(1));
    EXPECT_EQ(w.builder().reduce(Reduction::ForAll, w.none, up()), w.boolean(true));
    EXPECT_EQ(w.builder().reduce(Reduction::Exists, w.none, up()), w.boolean(false));
}

TEST_F(BuilderTest, SearchesConstants) {
    const BufferId ends = w.add("ENDS", Storage::Constant, Scalar::Real, true, {1.0, 2.0, 4.0});
    EXPECT_EQ(text(w.builder().search(ends, level())), "search(ENDS, state.level)");
    EXPECT_EQ(w.builder().search(ends, w.real(0.5)), w.integer(0));
    EXPECT_EQ(w.builder().search(ends, w.real(2)), w.integer(2));
    EXPECT_EQ(w.builder().search(ends, w.real(9)), w.integer(3));
    EXPECT_EQ(w.builder().search(ends, w.real(std::nan(""))), w.integer(0));
}

TEST_F(BuilderTest, ChoosesBetweenConvertedConstants) {
    const NodeId choice = w.builder().select(up(), w.integer(0), w.integer(3));
    EXPECT_EQ(w.builder().convert(choice, Scalar::Real),
              w.builder().select(up(), w.real(0), w.real(3)));
}

TEST_F(BuilderTest, ConvertsBoolToRealInOneStep) {
    const NodeId as_int = w.builder().convert(up(), Scalar::Int);
    EXPECT_EQ(w.builder().convert(as_int, Scalar::Real), w.builder().convert(up(), Scalar::Real));
}

}  // namespace
}  // namespace rddlc::ir
