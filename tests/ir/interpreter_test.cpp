#include "ir/interpreter.hpp"

#include "ir/verify.hpp"
#include "programs.hpp"

#include <rddl/random/distributions.hpp>
#include <rddl/random/random.hpp>
#include <rddl/step/engine.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cstring>

namespace rddlc::ir {
namespace {

static_assert(rddl::Engine<Interpreter>);

template <class Record>
std::byte* bytes(Record& record) {
    return reinterpret_cast<std::byte*>(&record);
}

class InterpreterTest : public testing::Test {
  protected:
    // The next state where `value` is stored to level, count or running.
    WorkbenchState step_with(Definition definition) {
        add_step(w);
        for (Definition& each : w.program.step) {
            if (each.target == definition.target) each = definition;
        }
        return step();
    }
    WorkbenchState step() {
        const Interpreter interpreter(w.program);
        EXPECT_EQ(interpreter.state_size(), sizeof(WorkbenchState));
        WorkbenchState state, next;
        interpreter.reset(bytes(state), context);
        std::array<bool, 3> action{};
        std::array<std::byte, 64> scratch;
        reward = interpreter.step(bytes(state), bytes(action), scratch.data(), bytes(next),
                                  scratch.data(), context);
        return next;
    }
    double real_value(NodeId id) { return step_with(w.assign(w.next_level, id)).level; }
    std::int64_t int_value(NodeId id) { return step_with(w.assign(w.next_count, id)).count; }

    Workbench w;
    Context context{.key = rddl::stream_key(1, 2, 3), .step = 1, .fault = {}};
    double reward = 0;
};

TEST_F(InterpreterTest, StartsWithTheInitialState) {
    const Interpreter interpreter(w.program);
    WorkbenchState state;
    interpreter.reset(bytes(state), context);
    EXPECT_TRUE(state.running[0] && state.running[1] && !state.running[2]);
    EXPECT_EQ(state.level, 2.0);
    EXPECT_EQ(state.count, 7);
}

TEST_F(InterpreterTest, DrawsInitialValues) {
    add_step(w);
    const NodeId normal = w.builder().sample(Scalar::Real, Distribution::Normal,
                                             {SiteId{2}, w.integer(0)}, {w.real(5.0), w.real(1.0)});
    w.program.reset = {w.assign(w.level, normal)};
    EXPECT_EQ(verify(w.program), std::vector<std::string>{});
    const Interpreter interpreter(w.program);
    WorkbenchState state, again, other;
    interpreter.reset(bytes(state), context);
    interpreter.reset(bytes(again), context);
    EXPECT_EQ(state.level, again.level);
    EXPECT_EQ(state.count, 7);
    context = {rddl::stream_key(1, 2, 4), 0, {}};
    interpreter.reset(bytes(other), context);
    EXPECT_NE(state.level, other.level) << "of another episode";
}

TEST_F(InterpreterTest, ComputesAStep) {
    add_step(w);
    const WorkbenchState next = step();
    EXPECT_EQ(next.level, 3.0);
    EXPECT_EQ(next.count, 8);
    EXPECT_FALSE(next.running[2]);
    EXPECT_EQ(reward, 1.0);  // of the running ones, only c1 is connected
    EXPECT_FALSE(context.fault);
}

TEST_F(InterpreterTest, DrawsAsTheRuntimeDoes) {
    add_step(w);
    const WorkbenchState next = step();
    for (std::uint32_t c = 0; c < 2; ++c) {
        Context same{.key = context.key, .step = 1, .fault = {}};
        EXPECT_EQ(next.running[c], rddl::sample::bernoulli(same, {0, c}, 0.5));
    }
}

TEST_F(InterpreterTest, ChecksConditions) {
    add_step(w);
    const Interpreter interpreter(w.program);
    WorkbenchState state{{true, true, true}, 2.0, 8};
    std::array<bool, 3> action{};
    EXPECT_FALSE(interpreter.terminal(bytes(state), context));
    EXPECT_FALSE(interpreter.violates_invariant(bytes(state), context));
    EXPECT_EQ(interpreter.violated_precondition(bytes(state), bytes(action), context), 0);
    state.level = 4.5;
    state.count = 9;
    action[1] = true;
    EXPECT_TRUE(interpreter.terminal(bytes(state), context));
    EXPECT_TRUE(interpreter.violates_invariant(bytes(state), context));
    EXPECT_EQ(interpreter.violated_precondition(bytes(state), bytes(action), context), -1);
}

TEST_F(InterpreterTest, EvaluatesReductions) {
    Builder& b = w.builder();
    const NodeId up = b.convert(w.at(w.running, w.c), Scalar::Int);
    const NodeId place = b.index(w.c);
    EXPECT_EQ(int_value(b.reduce(Reduction::Sum, w.c, up)), 2);
    EXPECT_EQ(int_value(b.reduce(Reduction::Product, w.c, up)), 0);
    EXPECT_EQ(int_value(b.reduce(Reduction::ArgMin, w.c, up)), 2);
    EXPECT_EQ(int_value(b.reduce(Reduction::ArgMax, w.c, b.convert(up, Scalar::Real))), 0);
    EXPECT_EQ(int_value(b.reduce(Reduction::Maximum, w.c,
                                 w.apply(Operator::Add, w.load(w.count), place))),
              9);
}

TEST_F(InterpreterTest, ReducesOverAPartOfTheRange) {
    Builder& b = w.builder();
    const Bounds last_two{w.integer(1), w.integer(3)};
    const NodeId place = b.index(w.c);
    EXPECT_EQ(int_value(b.reduce(Reduction::Sum, w.c, place, last_two)), 1 + 2);
    EXPECT_EQ(int_value(b.reduce(Reduction::Product, w.c, place, last_two)), 1 * 2);
    const Bounds none{w.integer(2), w.integer(1)};
    EXPECT_EQ(int_value(b.reduce(Reduction::Product, w.c, place, none)), 1);
}

TEST_F(InterpreterTest, CountsBits) {
    const NodeId bits = w.builder().bits(w.running, 0);
    EXPECT_EQ(int_value(w.apply(Operator::CountOnes, bits)), 2);
    EXPECT_EQ(int_value(w.apply(Operator::BitOr, bits, w.integer(8))), int_value(bits) + 8);
    EXPECT_EQ(int_value(w.apply(Operator::BitXor, bits, bits)), 0);
    EXPECT_EQ(int_value(w.apply(Operator::ShiftRight, bits, w.integer(1))), int_value(bits) / 2);
}

TEST_F(InterpreterTest, NestsReductions) {
    Builder& b = w.builder();
    const NodeId product =
        w.apply(Operator::Multiply, b.convert(w.at(w.running, w.c), Scalar::Int), b.index(w.d));
    const NodeId sum = b.reduce(Reduction::Sum, w.c, b.reduce(Reduction::Sum, w.d, product));
    EXPECT_EQ(int_value(sum), 2 * (0 + 1 + 2));
}

TEST_F(InterpreterTest, TakesOnlyOneBranch) {
    Builder& b = w.builder();
    const NodeId fault = b.fault(Scalar::Real, {SiteId{1}, w.integer(0)});
    const NodeId few = w.apply(Operator::Less, w.load(w.count), w.integer(8));
    EXPECT_EQ(real_value(b.select(few, w.real(5), fault)), 5.0);
    EXPECT_FALSE(context.fault);
    EXPECT_EQ(real_value(b.select(few, fault, w.real(5))), 0.0);
    EXPECT_EQ(context.fault.kind, rddl::FaultKind::Type);
    EXPECT_EQ(context.fault.place, (rddl::Place{1, 0}));
}

TEST_F(InterpreterTest, RecordsFaultsOfOperators) {
    const NodeId negative = w.apply(Operator::Negate, w.load(w.count));
    EXPECT_EQ(int_value(w.int_power(w.load(w.count), negative)), 0);
    EXPECT_EQ(context.fault.kind, rddl::FaultKind::NegativeExponent);
    EXPECT_EQ(context.fault.value, -7.0);
}

TEST_F(InterpreterTest, DrawsFromWeights) {
    Builder& b = w.builder();
    const Place place{SiteId{1}, w.integer(0)};
    const NodeId zero = w.apply(Operator::Subtract, w.load(w.level), w.real(2));
    const NodeId one = w.apply(Operator::Subtract, w.load(w.level), w.real(1));
    EXPECT_EQ(int_value(b.discrete(false, place, {zero, zero, one})), 2);
    EXPECT_EQ(int_value(b.discrete(true, place, {zero, w.load(w.level), zero})), 1);
    const NodeId weight =
        b.convert(w.apply(Operator::Equal, b.index(w.d), w.integer(2)), Scalar::Real);
    EXPECT_EQ(int_value(b.discrete_over(false, place, w.d, weight)), 2);
    EXPECT_EQ(int_value(b.discrete_over(true, place, w.d, weight)), 2);
}

TEST_F(InterpreterTest, RemembersLocals) {
    add_step(w);
    w.program.local_count = 2;
    const NodeId twice = w.apply(Operator::Multiply, w.load(w.level), w.real(2));
    const NodeId local = w.builder().local(LocalId{1}, Scalar::Real);
    w.program.step[2].body = {{Let{LocalId{1}, twice}},
                              {Store{w.next_level, {}, w.apply(Operator::Add, local, local)}}};
    EXPECT_EQ(step().level, 8.0);
}

TEST_F(InterpreterTest, FindsRoomForManyLocals) {
    add_step(w);
    constexpr std::uint32_t count = 2000;
    w.program.local_count = count;
    Block block = {{Let{LocalId{0}, w.load(w.level)}}};
    for (std::uint32_t i = 1; i < count; ++i) {
        const NodeId before = w.builder().local(LocalId{i - 1}, Scalar::Real);
        block.push_back({Let{LocalId{i}, w.apply(Operator::Add, before, w.real(1))}});
    }
    block.push_back({Store{w.next_level, {}, w.builder().local(LocalId{count - 1}, Scalar::Real)}});
    w.program.step[2].body = std::move(block);
    EXPECT_EQ(step().level, 2.0 + count - 1);
}

// The level plus a number from a table that it gets whole.
std::int32_t third_of(const rddl_array* arguments, std::int32_t count, const rddl_array* result) {
    const bool fits = count == 2 && arguments[0].rank == 1 && arguments[0].shape[0] == 3 &&
                      arguments[0].scalar == RDDL_BOOL && arguments[1].rank == 0 &&
                      arguments[1].scalar == RDDL_REAL && result->scalar == RDDL_REAL;
    if (!fits) return 0;
    if (!result->data) return 1;
    const auto* running = static_cast<const bool*>(arguments[0].data);
    const double level = *static_cast<const double*>(arguments[1].data);
    *static_cast<double*>(result->data) = level + (running[2] ? 100 : 200);
    return 1;
}

TEST_F(InterpreterTest, FillsAVectorWithSinesAndCosines) {
    const BufferId angles = w.add("angles", Storage::Scratch, Scalar::Real, false, {});
    w.program.buffers[angles.index].shape = {2};
    const auto element = [&](std::int64_t k) {
        return w.builder().load(angles, {w.integer(k)});
    };
    const NodeId level = w.load(w.level);
    Definition definition =
        w.assign(w.next_level, w.apply(Operator::Subtract, element(0), element(1)));
    const Call call{Together{},
                    {},
                    {w.apply(Operator::Sin, level), w.apply(Operator::Cos, level)},
                    {angles, {}},
                    {}};
    definition.body.insert(definition.body.begin(), Statement{call});
    EXPECT_EQ(step_with(definition).level, rddl::sin(2.0) - rddl::cos(2.0));
    for (const std::string& complaint : verify(w.program)) ADD_FAILURE() << complaint;
}

TEST_F(InterpreterTest, CallsExternalFunctions) {
    add_step(w);
    w.program.externals = {{"third", {}}};
    w.program.buffers.push_back({"third", Storage::Scratch, Scalar::Real, {}, {}, {}, {}, {}});
    const BufferId result{static_cast<std::uint32_t>(w.program.buffers.size() - 1)};
    const Call call{ExternalId{0}, {{w.running, {}}, {w.level, {}}}, {}, {result, {}}, {}};
    w.program.reward = {{{call}}, w.load(result), {}};
    ASSERT_TRUE(accepts(third_of, w.program, call));
    Call other = call;
    other.inputs.pop_back();
    EXPECT_FALSE(accepts(third_of, w.program, other));

    const Interpreter interpreter(w.program, {third_of});
    WorkbenchState state, next;
    interpreter.reset(bytes(state), context);
    std::array<bool, 3> action{};
    std::array<std::byte, 64> scratch;
    for (const bool runs : {true, false}) {
        state.running[2] = runs;
        const double value = interpreter.step(bytes(state), bytes(action), scratch.data(),
                                              bytes(next), scratch.data(), context);
        EXPECT_EQ(value, state.level + (runs ? 100 : 200));
    }
}

}  // namespace
}  // namespace rddlc::ir
