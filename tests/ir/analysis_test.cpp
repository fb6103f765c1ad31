#include "ir/analysis.hpp"

#include "ir/evaluator.hpp"
#include "ir/print.hpp"
#include "programs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rddlc::ir {
namespace {

class AnalysisTest : public testing::Test {
  protected:
    const Properties& properties(NodeId id) { return w.builder().properties(id); }
    Workbench w;
};

TEST_F(AnalysisTest, UniformIsWhatNoStateHasAPartIn) {
    EXPECT_TRUE(properties(w.at(w.connected, w.c)).uniform);
    EXPECT_TRUE(properties(w.builder().index(w.c)).uniform);
    EXPECT_FALSE(properties(w.at(w.running, w.c)).uniform);
    EXPECT_FALSE(properties(w.builder().load(w.connected, {w.load(w.count)})).uniform);
    EXPECT_FALSE(properties(w.bernoulli(w.real(0.5))).uniform);
}

TEST_F(AnalysisTest, KnowsWhatIsNeverNegativeZero) {
    const NodeId x = w.load(w.level), one = w.real(1), zero = w.real(0);
    const auto never = [&](NodeId id) {
        return properties(id).never_negative_zero;
    };
    EXPECT_FALSE(never(x));
    EXPECT_FALSE(never(w.real(-0.0)));
    EXPECT_TRUE(never(w.builder().convert(w.load(w.count), Scalar::Real)));
    EXPECT_TRUE(never(w.load(w.reboot_prob)));
    EXPECT_TRUE(never(w.builder().reduce(Reduction::Sum, w.c, x)));
    EXPECT_FALSE(never(w.builder().reduce(Reduction::Product, w.c, x)));
    EXPECT_TRUE(never(w.apply(Operator::Add, x, one)));
    EXPECT_TRUE(never(w.apply(Operator::Subtract, x, one)));
    EXPECT_FALSE(never(w.apply(Operator::Subtract, x, zero)));
    EXPECT_TRUE(never(w.apply(Operator::Multiply, x, x)));
    EXPECT_FALSE(never(w.apply(Operator::Multiply, x, one)));
    EXPECT_TRUE(never(w.apply(Operator::Maximum, zero, x)));
    EXPECT_FALSE(never(w.apply(Operator::Maximum, x, zero)));
}

// All that is said never to be -0.0, and all that 0.0 + x becomes, with the numbers at which the
// shortcuts go wrong.
TEST_F(AnalysisTest, NoOperatorMakesNegativeZerosThatAreNotExpected) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double least = std::numeric_limits<double>::denorm_min();
    const NodeId x = w.load(w.level);
    const NodeId count = w.builder().convert(w.load(w.count), Scalar::Real);
    std::vector<NodeId> operands = {x, count, w.apply(Operator::Abs, x),
                                    w.apply(Operator::Negate, x)};
    for (const double value : {0.0, -0.0, 1.5, -1.5, 1e-300, -1e-300})
        operands.push_back(w.real(value));
    operands.push_back(w.builder().aggregated(Reduction::Sum, x));
    std::vector<std::pair<NodeId, NodeId>> pairs;  // what an operator gives, and 0.0 plus it
    for (const Operator op :
         {Operator::Add, Operator::Subtract, Operator::Multiply, Operator::Divide,
          Operator::Minimum, Operator::Maximum, Operator::Power, Operator::Hypot,
          Operator::FloorModuloReal, Operator::Negate, Operator::Abs, Operator::Sqrt, Operator::Exp,
          Operator::Sin, Operator::Cosh}) {
        for (const NodeId a : operands) {
            for (const NodeId b : operands) {
                const bool is_unary = arity_of(op) == 1;
                const NodeId whole = is_unary ? w.apply(op, a) : w.apply(op, a, b);
                pairs.emplace_back(whole, w.builder().aggregated(Reduction::Sum, whole));
                if (is_unary) break;
            }
        }
    }
    const Evaluator evaluator(w.program);
    int checked = 0;
    for (const double level : {0.0, -0.0, 2.0, -2.0, least, -least, 1e-300, -1e-300, infinity,
                               -infinity, std::nan("")}) {
        for (const std::int64_t n : {0, 1, -1}) {
            const WorkbenchState state{{}, level, n};
            Context context;
            Evaluator::Frame frame(
                evaluator,
                Records().set(Storage::State, reinterpret_cast<const std::byte*>(&state)), context);
            for (const auto& [whole, begun] : pairs) {
                const double value = evaluator.value<double>(whole, frame);
                const double sum = evaluator.value<double>(begun, frame);
                const bool is_negative_zero = value == 0 && std::signbit(value);
                EXPECT_FALSE(is_negative_zero && properties(whole).never_negative_zero)
                    << print(w.program, whole) << " of " << level << ", " << n;
                const double expected = 0.0 + value;
                EXPECT_TRUE(identical(sum, expected) || (std::isnan(sum) && std::isnan(expected)))
                    << print(w.program, begun) << " of " << level << ", " << n;
                ++checked;
            }
        }
    }
    EXPECT_GT(checked, 10'000);
}

TEST_F(AnalysisTest, VariablesAreFreeUntilBound) {
    const NodeId body = w.at(w.running, w.c);
    EXPECT_EQ(properties(body).free_variables, std::vector{w.c});
    EXPECT_TRUE(
        properties(w.builder().reduce(Reduction::ForAll, w.c, body)).free_variables.empty());
    const NodeId both = w.apply(Operator::And, w.at(w.running, w.d), body);
    EXPECT_EQ(properties(both).free_variables, (std::vector{w.c, w.d}));
}

TEST_F(AnalysisTest, DrawsFaultUnlessTheirParametersAreKnown) {
    EXPECT_FALSE(properties(w.bernoulli(w.real(0.5))).may_fault);
    EXPECT_TRUE(properties(w.bernoulli(w.real(0.5))).random);
    EXPECT_TRUE(properties(w.bernoulli(w.real(1.5))).may_fault);
    EXPECT_TRUE(properties(w.bernoulli(w.load(w.level))).may_fault);
    const NodeId table = w.builder().convert(w.at(w.connected, w.c), Scalar::Real);
    const NodeId half = w.apply(Operator::Multiply, table, w.real(0.5));
    EXPECT_FALSE(properties(w.bernoulli(half)).may_fault);
}

TEST_F(AnalysisTest, PowersFaultUnlessTheExponentIsKnown) {
    EXPECT_TRUE(properties(w.int_power(w.load(w.count), w.load(w.count))).may_fault);
    EXPECT_FALSE(properties(w.int_power(w.load(w.count), w.integer(2))).may_fault);
    EXPECT_TRUE(properties(w.int_power(w.load(w.count), w.integer(-2))).may_fault);
}

TEST_F(AnalysisTest, CountsOfBitsHaveARange) {
    const NodeId bits = w.builder().bits(w.running, 0);
    EXPECT_EQ(properties(w.apply(Operator::CountOnes, bits)).range->upper, 3);
    const NodeId two = w.apply(Operator::BitAnd, bits, w.integer(5));
    EXPECT_EQ(properties(w.apply(Operator::CountOnes, two)).range->upper, 2);
    EXPECT_EQ(properties(w.apply(Operator::CountOnes, w.load(w.count))).range->upper, 64);
}

TEST_F(AnalysisTest, ProductsOfIntsHaveARangeAsReals) {
    const auto as_real = [&](NodeId a, NodeId b) {
        const NodeId product = w.apply(Operator::Multiply, a, b);
        return properties(w.builder().convert(product, Scalar::Real)).range;
    };
    const NodeId running = w.builder().convert(w.at(w.running, w.c), Scalar::Int);
    const NodeId connected = w.builder().convert(w.at(w.connected, w.c), Scalar::Int);
    EXPECT_EQ(as_real(running, connected), (Range{0, 1}));
    EXPECT_EQ(as_real(running, w.integer(-7)), (Range{-7, 0}));
    const Range any{-0x1p63, 0x1p63};
    EXPECT_EQ(as_real(running, w.integer(std::int64_t{1} << 53)), any);
    EXPECT_EQ(as_real(running, w.load(w.count)), any);
}

TEST_F(AnalysisTest, NumbersAreFiniteWhereTheirRangeShowsIt) {
    w.program.buffers[w.level.index].range = Range{-10, 10};
    const NodeId level = w.load(w.level);
    const NodeId square = w.apply(Operator::Multiply, level, level);
    EXPECT_EQ(properties(square).range, (Range{0, 100}));
    EXPECT_TRUE(properties(w.apply(Operator::Sqrt, square)).finite);
    EXPECT_TRUE(properties(w.apply(Operator::Power, square, w.real(0.5))).finite);
    EXPECT_FALSE(properties(w.apply(Operator::Power, square, w.real(-0.5))).finite);
    EXPECT_FALSE(properties(w.apply(Operator::Sqrt, level)).finite);
}

TEST_F(AnalysisTest, NumbersFromOutsideMayBeAnything) {
    const NodeId level = w.load(w.level);
    EXPECT_FALSE(properties(level).finite);
    EXPECT_FALSE(properties(w.apply(Operator::Multiply, level, level)).finite);
    EXPECT_TRUE(properties(w.builder().convert(w.load(w.count), Scalar::Real)).finite);
}

TEST_F(AnalysisTest, CheapIsAHandfulOfOperations) {
    const NodeId sum = w.apply(Operator::Add, w.load(w.level), w.real(2));
    EXPECT_TRUE(is_cheap(properties(sum)));
    EXPECT_FALSE(is_cheap(properties(w.apply(Operator::Exp, sum))));
    EXPECT_FALSE(is_cheap(properties(w.bernoulli(w.real(0.5)))));
    EXPECT_FALSE(is_cheap(properties(w.int_power(w.load(w.count), w.load(w.count)))));
}

TEST_F(AnalysisTest, CostsMultiplyInLoops) {
    const NodeId body = w.builder().convert(w.at(w.running, w.c), Scalar::Int);
    const NodeId sum = w.builder().reduce(Reduction::Sum, w.c, body);
    EXPECT_GE(properties(sum).cost, 3 * properties(body).cost);
}

TEST_F(AnalysisTest, RowsOfATableHaveAverageLength) {
    w.program.variables.push_back({"entry", {}, 30});
    const VariableId entry{4};
    const BufferId rows =
        w.add("ROW", Storage::Constant, Scalar::Int, false,
              {std::int64_t{0}, std::int64_t{7}, std::int64_t{15}, std::int64_t{30}});
    w.program.buffers[rows.index].shape = {4};
    Builder& b = w.builder();
    const Bounds row{b.load(rows, {b.index(w.c)}),
                     b.load(rows, {w.apply(Operator::Add, b.index(w.c), w.integer(1))})};
    const NodeId body = w.apply(Operator::Multiply, b.index(entry), w.load(w.count));
    const NodeId sum = b.reduce(Reduction::Sum, entry, body, row);
    EXPECT_EQ(properties(sum).free_variables, std::vector{w.c});
    EXPECT_LT(properties(sum).cost, 20 * properties(body).cost);
    EXPECT_GE(properties(sum).cost, 10 * properties(body).cost);
}

TEST_F(AnalysisTest, OnlyWhatIsEvaluatedIsReachable) {
    add_step(w);
    const NodeId unused = w.apply(Operator::Cos, w.load(w.level));
    const std::vector<bool> reachable = reachable_nodes(w.program);
    EXPECT_FALSE(reachable[unused.index]);
    EXPECT_TRUE(reachable[w.program.reward.value.index]);
    EXPECT_TRUE(is_stochastic(w.program));
}

TEST_F(AnalysisTest, ADrawThatNobodyEvaluatesIsNotStochastic) {
    w.bernoulli(w.real(0.5));
    EXPECT_FALSE(is_stochastic(w.program));
}

}  // namespace
}  // namespace rddlc::ir
