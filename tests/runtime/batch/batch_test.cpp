// An environment's trajectory is bit for bit the same whatever the batch around it, its place in it
// and the number of threads. lanes_test.cpp tests the number of environments that are stepped
// together.
#include "trajectories.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

namespace tiny {
namespace {

TEST(Trajectories, CoverEveryCauseOfAnEnd) {
    int causes = 0;
    for (const Trajectory& trajectory : reference())
        for (const Told& told : trajectory) causes |= told.causes;
    EXPECT_EQ(causes,
              RDDL_TERMINATED | RDDL_TRUNCATED_HORIZON | RDDL_TRUNCATED_INVARIANT | RDDL_FAULTED);
}

TEST(Trajectories, DoNotDependOnTheBatchOrThePlace) {
    for (const std::int64_t size : {1, 7, 64, 1000})
        for (std::int64_t first = 0; first < all_environments; first += 83 * size) {
            const std::int64_t count = std::min(size, all_environments - first);
            const auto found = trajectories(first, count, 1);
            for (std::int64_t i = 0; i < count; ++i)
                ASSERT_EQ(found[static_cast<std::size_t>(i)],
                          reference()[static_cast<std::size_t>(first + i)])
                    << "environment " << first + i << " in a batch of " << size;
        }
}

TEST(Trajectories, DoNotDependOnTheThreads) {
    for (const int threads : {2, 3, 4, 0})
        EXPECT_EQ(trajectories(0, all_environments, threads), reference()) << threads;
    EXPECT_EQ(trajectories(0, 5, 4),
              std::vector<Trajectory>(reference().begin(), reference().begin() + 5));
}

// The values of a record as a row of a matrix.
template <class Number>
void append(std::vector<Number>& row, const ActionRecord& action) {
    for (const bool repair : action.repair) row.push_back(repair);
    row.push_back(static_cast<Number>(action.set_mode));
    row.push_back(static_cast<Number>(action.hazard));
}
template <class Number>
void append(std::vector<Number>& row, const StateRecord& state) {
    for (const double wear : state.wear) row.push_back(static_cast<Number>(wear));
    for (const bool running : state.running) row.push_back(running);
    row.push_back(static_cast<Number>(state.mode));
    row.push_back(static_cast<Number>(state.repairs));
}

template <class Number>
void expect_matrices_like_records(rddl_number number, std::int64_t count) {
    const rddl_batch_options options = batch_options(count, 0, 42, 1, RDDL_AUTORESET_SAME_STEP);
    TinyBatch records(options), matrices(options);
    ASSERT_EQ(simulator()->action_value_count(simulator()), machines + 2);
    ASSERT_EQ(simulator()->observation_value_count(simulator()), 2 * machines + 2);
    const auto width = static_cast<std::size_t>(2 * machines + 2);
    std::vector<Number> observations(records.size() * width);
    for (int time = 0; time < step_count; ++time) {
        std::vector<Number> actions, expected;
        for (std::size_t i = 0; i < records.size(); ++i) {
            records.actions[i] = action_of(static_cast<std::int64_t>(i), time);
            append(actions, records.actions[i]);
        }
        records.step();
        for (const StateRecord& state : records.observations) append(expected, state);
        rddl_transition out{};
        out.rewards = matrices.rewards.data();
        ASSERT_EQ(simulator()->step_values(matrices.get(), number, actions.data(),
                                           observations.data(), &out),
                  RDDL_OK);
        EXPECT_EQ(matrices.rewards, records.rewards);
        EXPECT_EQ(observations, expected);
        std::ranges::fill(observations, Number{-1});
        ASSERT_EQ(simulator()->get_observation_values(matrices.get(), number, observations.data()),
                  RDDL_OK);
        EXPECT_EQ(observations, expected);
    }
}

TEST(Matrices, StepLikeRecords) {
    for (const std::int64_t count : {1, 7, 40}) {
        expect_matrices_like_records<double>(RDDL_DOUBLE, count);
        expect_matrices_like_records<float>(RDDL_FLOAT, count);
    }
}

TEST(Matrices, OfActionsThatAreNoneAreRefused) {
    TinyBatch batch(batch_options(1, 0, 42, 1, RDDL_AUTORESET_DISABLED));
    const rddl_transition out{};
    const auto status_of = [&](double repair, double mode) {
        const double row[] = {repair, 0, 0, mode, 0};
        return simulator()->step_values(batch.get(), RDDL_DOUBLE, row, nullptr, &out);
    };
    EXPECT_EQ(status_of(1, 1), RDDL_OK);
    EXPECT_EQ(status_of(std::nan(""), 1), RDDL_BAD_ARGUMENT);
    EXPECT_EQ(status_of(1, 2), RDDL_BAD_ARGUMENT) << "there are two modes";
    EXPECT_EQ(status_of(1, -1), RDDL_BAD_ARGUMENT);
    EXPECT_EQ(simulator()->step_values(batch.get(), RDDL_DOUBLE, nullptr, nullptr, &out),
              RDDL_BAD_ARGUMENT);
    EXPECT_STREQ(simulator()->last_error(simulator()), "the actions are missing");
}

TEST(Trajectories, DependOnTheSeed) {
    TinyBatch one(batch_options(1, 0, 1, 1, RDDL_AUTORESET_DISABLED));
    TinyBatch other(batch_options(1, 0, 2, 1, RDDL_AUTORESET_DISABLED));
    one.step();
    other.step();
    EXPECT_NE(one.observations[0].wear, other.observations[0].wear);
}

TEST(Trajectories, AreRepeatedBySettingTheState) {
    TinyBatch batch(batch_options(8, 0, 42, 1, RDDL_AUTORESET_DISABLED, RDDL_NO_HORIZON));
    batch.step();
    const auto before = batch.states();
    batch.step();
    // The step counter continues, so that the same state meets new random numbers...
    const auto first_time = batch.states();
    ASSERT_EQ(simulator()->set_state(batch.get(), 0, 8, before.data(), nullptr), RDDL_OK);
    batch.step();
    EXPECT_NE(batch.states()[0].wear, first_time[0].wear);
    // ... while a copy made before the step repeats it.
    TinyBatch copy(simulator()->copy(batch.get()), 8);
    batch.step();
    copy.step();
    EXPECT_EQ(
        std::memcmp(batch.observations.data(), copy.observations.data(), 8 * sizeof(StateRecord)),
        0);
}

}  // namespace
}  // namespace tiny
