// Whole rollouts: what the interpreter computes, and that optimising changes no bit of it.
#include "ir/interpreter.hpp"
#include "ir/layout.hpp"
#include "ir/print.hpp"
#include "passes/passes.hpp"
#include "problem.hpp"

#include <rddl/random/random.hpp>

#include <gtest/gtest.h>

#include <cstring>
#include <random>

namespace rddlc {
namespace {

class Rollout {
  public:
    explicit Rollout(ir::Program program)
        : engine_(std::move(program)),
          state_(engine_.state_size()),
          next_(engine_.state_size()),
          action_(engine_.action_size()),
          scratch_(engine_.scratch_size()),
          observation_(engine_.observation_size()) {
        Context context{.key = rddl::stream_key(1, 0, 0), .step = 0, .fault = {}};
        engine_.reset(state_.data(), context);
        engine_.default_action(action_.data());
    }

    // Flips a coin for each bool action, draws a small number for others.
    void act(std::mt19937_64& random) {
        for (const ir::Field& field :
             ir::record_layout(engine_.program(), ir::Storage::Action).fields) {
            const ir::Buffer& buffer = engine_.program()[field.buffer];
            for (std::int64_t i = 0; i < buffer.count(); ++i) {
                std::byte* at = action_.data() + field.offset +
                                static_cast<std::size_t>(i) * ir::size_of(buffer.scalar);
                const std::uint64_t draw = random() % 3;
                const auto whole = static_cast<std::int64_t>(draw);
                const double real = 0.75 * static_cast<double>(draw);
                if (buffer.scalar == ir::Scalar::Bool) *at = std::byte(draw == 0);
                if (buffer.scalar == ir::Scalar::Int) std::memcpy(at, &whole, sizeof whole);
                if (buffer.scalar == ir::Scalar::Real) std::memcpy(at, &real, sizeof real);
            }
        }
    }

    void step() {
        context_.go_to_next_step();
        reward = engine_.step(state_.data(), action_.data(), scratch_.data(), next_.data(),
                              observation_.data(), context_);
        state_.swap(next_);
    }

    template <class T>
    T state(const std::string& name, std::size_t grounding = 0) const {
        for (const ir::Field& field :
             ir::record_layout(engine_.program(), ir::Storage::State).fields) {
            if (engine_.program()[field.buffer].name != name) continue;
            T value;
            std::memcpy(&value, state_.data() + field.offset + grounding * sizeof value,
                        sizeof value);
            return value;
        }
        ADD_FAILURE() << "no state-fluent " << name;
        return {};
    }

    const std::vector<std::byte>& state_bytes() const { return state_; }
    const std::vector<std::byte>& observation_bytes() const { return observation_; }
    const rddl::FaultRecord& fault() const { return context_.fault; }

    double reward = 0;

  private:
    ir::Interpreter engine_;
    std::vector<std::byte> state_, next_, action_, scratch_, observation_;
    Context context_{.key = rddl::stream_key(11, 0, 0), .step = 0, .fault = {}};
};

TEST(Rollout, ComputesWhatRddlMeans) {
    Rollout rollout(grounded(usual_problem(
        "[sum_{?o : obj} v(?o) * R(?o)] + (if (exists_{?o : obj, ?b : pair} B(?o, ?b)) then "
        "div[n, 2] else 0) + q(near(argmax_{?o : obj} R(?o)))")));
    rollout.step();
    EXPECT_EQ(rollout.state<double>("x"), 4.5 + 1 + 0.5);
    EXPECT_EQ(rollout.state<std::int64_t>("near", 1), 1);
    EXPECT_EQ(rollout.reward, 0.0);
}

TEST(Rollout, ProductsWithZeroAreZeroOutsideOfScopes) {
    Rollout rollout(grounded(usual_problem("f * (1 / f)")));
    rollout.step();
    EXPECT_EQ(rollout.state<double>("x"), 0.0);
}

TEST(Rollout, FaultsNameTheirPlace) {
    const ir::Program program = grounded(usual_problem("sum_{?o : obj} Bernoulli(R(?o))"));
    Rollout rollout(program);
    rollout.step();
    EXPECT_EQ(rollout.fault().kind, rddl::FaultKind::Probability);
    EXPECT_EQ(rollout.fault().place, (rddl::Place{0, 1}));  // R(b2) is 2.5
    EXPECT_EQ(rollout.fault().value, 2.5);
    EXPECT_EQ(program.sites[0].what, "Bernoulli");
}

// A bit of everything.
Problem busy_problem() {
    return {
        .pvariables =
            "LINK(obj, obj) : { non-fluent, bool, default = false };\n"
            "GAIN(obj) : { non-fluent, real, default = 0.25 };\n"
            "SAME(obj) : { non-fluent, real, default = 1.5 };\n"
            "up(obj) : { state-fluent, bool, default = true };\n"
            "load(obj) : { state-fluent, real, default = 1.0 };\n"
            "hue(obj) : { state-fluent, color, default = @red };\n"
            "steps : { state-fluent, int, default = 0 };\n"
            "fix(obj) : { action-fluent, bool, default = false };\n"
            "push(obj) : { action-fluent, real, default = 0.0 };\n"
            "noise(obj) : { interm-fluent, real };\n"
            "unread(obj) : { interm-fluent, real };\n"
            "busiest : { interm-fluent, color };\n"
            "seen(obj) : { observ-fluent, bool };\n"
            "total : { observ-fluent, real };",
        .cpfs =
            "noise(?o) = Normal(0, GAIN(?o)) * (if (up(?o)) then 1.0 else 0.1);\n"
            "unread(?o) = Uniform(0, 1) + noise(?o);\n"
            "busiest = hue(argmax_{?o : obj} load(?o));\n"
            "up'(?o) = if (fix(?o)) then KronDelta(true) else up(?o) ^ Bernoulli(0.4 + 0.5 * "
            "(1 + sum_{?u : obj} [LINK(?u, ?o) ^ up(?u)]) / (1 + sum_{?u : obj} LINK(?u, ?o)));\n"
            "load'(?o) = max[0, load(?o) * SAME(?o) - push(?o) + noise(?o) + "
            "(avg_{?u : obj} load(?u)) + exp[-(sum_{?u : obj} load(?u)) / 10] + "
            "(if ((sum_{?u : obj} load(?u)) > 5) then 1 else 0)];\n"
            "hue'(?o) = switch (hue(?o)) { case @red : Discrete(color, @red : 0.5, @green : 0.5, "
            "@blue : 0), case @green : @blue, default : UnnormDiscrete_{?k : color} "
            "[1 + (?k == busiest)] };\n"
            "steps' = steps + 1 + Poisson(0.5) + Binomial(3, 0.5) * (steps < 100);\n"
            "seen(?o) = up'(?o) ^ Bernoulli(0.9);\n"
            "total = sum_{?o : obj} load'(?o) * load'(?o);",
        .reward = "[sum_{?o : obj} [up(?o) - 0.1 * fix(?o)]] - steps' * (prod_{?o : obj} GAIN(?o))",
        .non_fluents = "LINK(b1, b2); LINK(b2, b3); LINK(b3, b1); GAIN(b2) = 0.5;"};
}

// 200 steps of both.
void expect_equal_rollouts(const ir::Program& program, const ir::Program& optimised) {
    EXPECT_TRUE(ir::verify(optimised).empty());
    Rollout plain(program), fast(optimised);
    std::mt19937_64 random(3);
    for (int step = 0; step < 200; ++step) {
        std::mt19937_64 same = random;
        plain.act(random);
        fast.act(same);
        plain.step();
        fast.step();
        ASSERT_EQ(plain.state_bytes(), fast.state_bytes()) << step;
        ASSERT_EQ(plain.observation_bytes(), fast.observation_bytes()) << step;
        ASSERT_EQ(std::memcmp(&plain.reward, &fast.reward, sizeof plain.reward), 0) << step;
        ASSERT_FALSE(plain.fault());
    }
    EXPECT_GT(plain.state<std::int64_t>("steps"), 200);
}

TEST(Rollout, IsTheSameBitForBitAfterOptimising) {
    const ir::Program program = grounded(busy_problem());
    const ir::Program optimised = optimise(program);
    EXPECT_NE(ir::print(optimised), ir::print(program));
    EXPECT_GT(optimised.local_count, 0u);
    expect_equal_rollouts(program, optimised);
}

TEST(Rollout, IsTheSameWithoutAnyOfThePasses) {
    const ir::Program program = grounded(busy_problem());
    for (const PassDescription& pass : all_passes()) {
        SCOPED_TRACE(pass.name);
        expect_equal_rollouts(program, optimise(program, {.without = {std::string(pass.name)}}));
    }
}

}  // namespace
}  // namespace rddlc
