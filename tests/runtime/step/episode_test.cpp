// How episodes end and start again, on a batch of counters.
#include "counter_engine.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rddl {
namespace {

// A batch with the arrays that a step reads and writes.
struct Counters {
    Counters(const CounterEngine& engine, BatchOptions options)
        : batch(engine, counter_problem, options),
          n(static_cast<std::size_t>(options.environment_count)) {}

    void step(const std::vector<std::int64_t>& actions) {
        rddl_transition out{};
        out.observations = observations.data();
        out.rewards = rewards.data();
        out.terminated = terminated.data();
        out.truncated = truncated.data();
        out.causes = causes.data();
        out.final_observations = finals.data();
        batch.step(reinterpret_cast<const std::byte*>(actions.data()), out);
    }
    void step() { step(std::vector<std::int64_t>(n, 1)); }
    std::int64_t count(std::int64_t i) const {
        std::int64_t count;
        batch.get_state(i, reinterpret_cast<std::byte*>(&count));
        return count;
    }

    Batch<CounterEngine> batch;
    std::size_t n;
    std::vector<double> observations = std::vector<double>(n, -1), rewards = observations,
                        finals = observations;
    std::vector<std::uint8_t> terminated = std::vector<std::uint8_t>(n, 9), truncated = terminated,
                              causes = terminated;
};

BatchOptions options_of(std::int64_t count, rddl_autoreset autoreset = RDDL_AUTORESET_DISABLED,
                        std::int64_t horizon = 0) {
    return {.environment_count = count,
            .seed = 3,
            .autoreset = autoreset,
            .horizon = horizon,
            .partially_observed = true};
}

TEST(Episodes, EndByTermination) {
    const CounterEngine engine{.terminal_from = 2};
    Counters counters(engine, options_of(1));
    counters.step();
    EXPECT_EQ(counters.causes[0], RDDL_RUNNING);
    EXPECT_EQ(counters.terminated[0], 0);
    counters.step();
    EXPECT_EQ(counters.causes[0], RDDL_TERMINATED);
    EXPECT_EQ(counters.terminated[0], 1);
    EXPECT_EQ(counters.truncated[0], 0);
    EXPECT_EQ(counters.rewards[0], 1.0);
}

TEST(Episodes, EndByTheHorizonAndTheInvariantAsTruncated) {
    const CounterEngine engine{.forbidden_from = 3};
    Counters counters(engine, options_of(2, RDDL_AUTORESET_DISABLED, 2));
    counters.step({1, 3});
    EXPECT_EQ(counters.causes[0], RDDL_RUNNING);
    EXPECT_EQ(counters.causes[1], RDDL_TRUNCATED_INVARIANT);
    EXPECT_EQ(counters.truncated[1], 1);
    EXPECT_EQ(counters.terminated[1], 0);
    EXPECT_EQ(counters.count(1), 3);
    counters.step({1, 1});
    EXPECT_EQ(counters.causes[0], RDDL_TRUNCATED_HORIZON);
    EXPECT_EQ(counters.truncated[0], 1);
}

TEST(Episodes, MayEndForSeveralReasonsAtOnce) {
    const CounterEngine engine{.terminal_from = 1, .forbidden_from = 1};
    Counters counters(engine, options_of(1, RDDL_AUTORESET_DISABLED, 1));
    counters.step();
    EXPECT_EQ(counters.causes[0],
              RDDL_TERMINATED | RDDL_TRUNCATED_HORIZON | RDDL_TRUNCATED_INVARIANT);
    EXPECT_EQ(counters.terminated[0], 1);
    EXPECT_EQ(counters.truncated[0], 1);
}

TEST(Episodes, WithoutHorizonGoOn) {
    const CounterEngine engine;
    Counters counters(engine, options_of(1));
    for (int t = 0; t < 1000; ++t) counters.step();
    EXPECT_EQ(counters.causes[0], RDDL_RUNNING);
    EXPECT_EQ(counters.batch.steps(0), 1000);
}

TEST(Episodes, AreOverAtOnceInATerminalInitialState) {
    const CounterEngine engine{.initial = 5, .terminal_from = 5};
    Counters counters(engine, options_of(1));
    EXPECT_EQ(counters.batch.causes(0), RDDL_TERMINATED);
    counters.step();
    EXPECT_EQ(counters.count(0), 5);
    EXPECT_EQ(counters.terminated[0], 1);
    EXPECT_EQ(counters.rewards[0], 0.0);
    EXPECT_EQ(counters.batch.steps(0), 0);
}

TEST(Autoreset, DisabledLeavesAnEndedEnvironmentAlone) {
    const CounterEngine engine{.terminal_from = 2};
    Counters counters(engine, options_of(2));
    counters.step({2, 1});
    const double last_observation = counters.observations[0];
    counters.step({5, 5});
    EXPECT_EQ(counters.count(0), 2);
    EXPECT_EQ(counters.rewards[0], 0.0);
    EXPECT_EQ(counters.terminated[0], 1);
    EXPECT_EQ(counters.observations[0], last_observation);
    EXPECT_EQ(counters.batch.steps(0), 1);
    EXPECT_EQ(counters.count(1), 6);
}

TEST(Autoreset, NextStepIgnoresTheAction) {
    const CounterEngine engine{.terminal_from = 2};
    Counters counters(engine, options_of(1, RDDL_AUTORESET_NEXT_STEP));
    counters.step({2});
    EXPECT_EQ(counters.terminated[0], 1);
    EXPECT_EQ(counters.count(0), 2);
    EXPECT_NE(counters.observations[0], 0.0);
    counters.step({2});
    EXPECT_EQ(counters.terminated[0], 0);
    EXPECT_EQ(counters.causes[0], RDDL_RUNNING);
    EXPECT_EQ(counters.rewards[0], 0.0);
    EXPECT_EQ(counters.count(0), 0);
    EXPECT_EQ(counters.observations[0], 0.0);
    EXPECT_EQ(counters.batch.episode_number(0), 1);
    EXPECT_EQ(counters.batch.steps(0), 0);
    counters.step({1});
    EXPECT_EQ(counters.count(0), 1);
}

TEST(Autoreset, SameStepTellsTheEndAndTheNewBeginning) {
    const CounterEngine engine{.terminal_from = 2};
    Counters counters(engine, options_of(2, RDDL_AUTORESET_SAME_STEP));
    counters.step({2, 1});
    EXPECT_EQ(counters.terminated[0], 1);
    EXPECT_EQ(counters.causes[0], RDDL_TERMINATED);
    EXPECT_EQ(counters.rewards[0], 2.0);
    EXPECT_EQ(counters.count(0), 0);
    EXPECT_EQ(counters.observations[0], 0.0);
    EXPECT_NEAR(counters.finals[0], 2.0, 6.0);
    EXPECT_NE(counters.finals[0], -1.0);
    EXPECT_EQ(counters.batch.causes(0), RDDL_RUNNING);
    EXPECT_EQ(counters.batch.episode_number(0), 1);
    EXPECT_EQ(counters.finals[1], -1.0);
    EXPECT_EQ(counters.batch.episode_number(1), 0);
}

TEST(Autoreset, OfATerminalInitialStateGivesEpisodesWithoutSteps) {
    const CounterEngine engine{.terminal_from = 0};
    for (const rddl_autoreset mode : {RDDL_AUTORESET_NEXT_STEP, RDDL_AUTORESET_SAME_STEP}) {
        Counters counters(engine, options_of(1, mode));
        for (int t = 1; t < 4; ++t) {
            counters.step();
            EXPECT_EQ(counters.terminated[0], 1);
            EXPECT_EQ(counters.rewards[0], 0.0);
            EXPECT_EQ(counters.batch.episode_number(0), t);
        }
    }
}

TEST(Episodes, HaveRandomNumbersOfTheirOwn) {
    const CounterEngine engine;
    Counters counters(engine, options_of(2, RDDL_AUTORESET_NEXT_STEP, 1));
    counters.step();
    const double first = counters.observations[0];
    EXPECT_NE(first, counters.observations[1]);
    counters.step();
    counters.step();
    EXPECT_NE(counters.observations[0], first);
}

TEST(Reset, StartsNewEpisodesUnderTheMask) {
    const CounterEngine engine;
    Counters counters(engine, options_of(3));
    counters.step();
    const double observed = counters.observations[1];
    const std::uint8_t mask[] = {1, 0, 1};
    std::array<double, 3> observations{7, 7, 7};
    counters.batch.reset(mask, reinterpret_cast<std::byte*>(observations.data()));
    EXPECT_EQ(observations[0], 0.0);
    EXPECT_EQ(observations[1], observed);
    EXPECT_EQ(observations[2], 0.0);
    EXPECT_EQ(counters.count(0), 0);
    EXPECT_EQ(counters.count(1), 1);
    EXPECT_EQ(counters.batch.episode_number(0), 1);
    EXPECT_EQ(counters.batch.episode_number(1), 0);
    EXPECT_EQ(counters.batch.steps(1), 1);
}

TEST(Faults, EndTheEpisodeAndChangeNothingElse) {
    const CounterEngine engine{.faulty_from = 5};
    Counters counters(engine, options_of(3)), undisturbed(engine, options_of(3));
    counters.step({1, 5, 1});
    undisturbed.step({1, 1, 1});
    const double observed = counters.observations[1];
    for (int t = 0; t < 3; ++t) {
        counters.step({1, 1, 1});
        undisturbed.step({1, 1, 1});
        EXPECT_EQ(counters.causes[1], RDDL_FAULTED);
        EXPECT_EQ(counters.truncated[1], 1);
        EXPECT_EQ(counters.terminated[1], 0);
        EXPECT_EQ(counters.rewards[1], 0.0);
        EXPECT_EQ(counters.observations[1], observed);
        EXPECT_EQ(counters.count(1), 5);
        for (const std::size_t i : {0u, 2u})
            EXPECT_EQ(counters.observations[i], undisturbed.observations[i]);
    }
    EXPECT_EQ(counters.batch.steps(1), 1);
    EXPECT_EQ(counters.batch.steps_before_fault(1), 1);
    const FaultRecord* const fault = counters.batch.fault(1);
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->kind, FaultKind::Probability);
    EXPECT_EQ(fault->value, 2.0);
}

TEST(Faults, InATerminationUndoTheStep) {
    const CounterEngine engine{.faulty_terminal = 3};
    Counters counters(engine, options_of(1));
    counters.step({1});
    counters.step({2});
    EXPECT_EQ(counters.causes[0], RDDL_FAULTED);
    EXPECT_EQ(counters.count(0), 1);
    ASSERT_TRUE(counters.batch.fault(0));
    EXPECT_EQ(counters.batch.fault(0)->kind, FaultKind::Type);
}

TEST(Faults, AtResetEndTheEpisode) {
    const CounterEngine engine{.initial = 3, .faulty_terminal = 3};
    Counters counters(engine, options_of(1));
    EXPECT_EQ(counters.batch.causes(0), RDDL_FAULTED);
    counters.step();
    EXPECT_EQ(counters.causes[0], RDDL_FAULTED);
    EXPECT_EQ(counters.count(0), 3);
}

TEST(Faults, OfInitialValuesEndTheEpisode) {
    const CounterEngine engine{.faulty_reset = true};
    Counters counters(engine, options_of(1, RDDL_AUTORESET_NEXT_STEP));
    EXPECT_EQ(counters.batch.causes(0), RDDL_FAULTED);
    ASSERT_TRUE(counters.batch.fault(0));
    EXPECT_EQ(counters.batch.fault(0)->kind, FaultKind::Type);
    counters.step();
    EXPECT_EQ(counters.batch.episode_number(0), 1) << "the next one";
    EXPECT_EQ(counters.batch.causes(0), RDDL_FAULTED);
}

TEST(Faults, CanBeReadUntilTheNextEpisodeMakesAStep) {
    const CounterEngine engine{.faulty_from = 5};
    Counters counters(engine, options_of(1, RDDL_AUTORESET_SAME_STEP));
    counters.step({5});
    counters.step({1});
    EXPECT_EQ(counters.causes[0], RDDL_FAULTED);
    EXPECT_EQ(counters.batch.causes(0), RDDL_RUNNING);
    ASSERT_TRUE(counters.batch.fault(0));
    EXPECT_EQ(counters.batch.fault(0)->kind, FaultKind::Probability);
    EXPECT_EQ(counters.batch.steps_before_fault(0), 1);
    counters.step({1});
    EXPECT_FALSE(counters.batch.fault(0));
}

TEST(SetState, MakesAnEndedEnvironmentRunUnlessTheStateIsTerminal) {
    const CounterEngine engine{.terminal_from = 5};
    Counters counters(engine, options_of(1));
    counters.step({7});
    EXPECT_NE(counters.batch.causes(0), RDDL_RUNNING);
    const auto set = [&](std::int64_t count) {
        counters.batch.set_state(0, reinterpret_cast<const std::byte*>(&count), nullptr);
    };
    set(2);
    EXPECT_EQ(counters.batch.causes(0), RDDL_RUNNING);
    EXPECT_EQ(counters.batch.steps(0), 1);
    EXPECT_EQ(counters.batch.episode_number(0), 0);
    counters.step({1});
    EXPECT_EQ(counters.count(0), 3);
    set(6);
    EXPECT_EQ(counters.batch.causes(0), RDDL_TERMINATED);
}

TEST(Preconditions, AreReportedAndNotEnforced) {
    const CounterEngine engine;
    Counters counters(engine, options_of(3));
    const std::vector<std::int64_t> actions{-1, 5, 11};
    std::array<std::int32_t, 3> violated{};
    counters.batch.violated_preconditions(reinterpret_cast<const std::byte*>(actions.data()),
                                          violated.data());
    EXPECT_EQ(violated, (std::array<std::int32_t, 3>{0, -1, 1}));
    counters.step(actions);
    EXPECT_EQ(counters.count(0), -1);
    EXPECT_EQ(counters.causes[0], RDDL_RUNNING);
}

TEST(Episodes, KnowACallerWhoGoesThroughAnArrayOfActions) {
    Episodes<Scalar> episodes;
    const std::array<std::byte, 3> rows{};
    detail::goes_on(&rows[0], episodes);
    EXPECT_FALSE(detail::goes_on(&rows[0], episodes));  // one buffer for all steps
    EXPECT_TRUE(detail::goes_on(&rows[1], episodes));
    EXPECT_TRUE(detail::goes_on(&rows[2], episodes));
    EXPECT_FALSE(detail::goes_on(&rows[0], episodes));  // the array from its begin on
}

}  // namespace
}  // namespace rddl
